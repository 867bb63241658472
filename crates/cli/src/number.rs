//! Numbers for a person: nine digits, no trailing zeros.

/// `0.125`, `1234.5`, `1.5e-7`.
pub fn human(x: f64) -> String {
    significant(x, 9)
}

/// Three digits.
pub fn brief(x: f64) -> String {
    significant(x, 3)
}

fn significant(x: f64, digits: i32) -> String {
    if x == 0.0 {
        return "0".into();
    }
    let exponent = x.abs().log10().floor() as i32;
    if (-4..digits).contains(&exponent) {
        let decimals = (digits - 1 - exponent).max(0) as usize;
        return trimmed(&format!("{x:.decimals$}")).into();
    }
    let text = format!("{x:.*e}", (digits - 1) as usize);
    match text.split_once('e') {
        Some((mantissa, exponent)) => format!("{}e{exponent}", trimmed(mantissa)),
        None => text,
    }
}

fn trimmed(text: &str) -> &str {
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { text }
}

/// `(1, 2.5, 0)`.
pub fn tuple(values: &[f64]) -> String {
    let words: Vec<String> = values.iter().map(|&x| human(x)).collect();
    format!("({})", words.join(", "))
}

/// The value, or `none`.
pub fn optional(value: Option<f64>) -> String {
    value.map_or_else(|| "none".into(), human)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn readable() {
        assert_eq!(human(0.1 + 0.2), "0.3");
        assert_eq!(human(-1234.5), "-1234.5");
        assert_eq!(human(1.5e-7), "1.5e-7");
        assert_eq!(human(1e9), "1e9");
        assert_eq!(human(123456789.0), "123456789");
        assert_eq!(human(-0.0), "0");
        assert_eq!(brief(2.0 / 3.0), "0.667");
        assert_eq!(tuple(&[1.0, 0.5]), "(1, 0.5)");
        assert_eq!(optional(None), "none");
    }
}
