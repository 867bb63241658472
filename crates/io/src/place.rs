use std::fmt;

/// A step into a JSON document.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Step {
    /// A field of an object.
    Field(&'static str),
    /// An element of an array.
    Index(usize),
}

/// Where in which file something is wrong: `FILE[:LINE[:COLUMN]][: PATH]`.
///
/// Lines and columns count from 1, columns in bytes; array indices in paths count from 0, like sides.
///
/// ```
/// use casteljau_io::Place;
/// let place = Place { line: Some(7), path: "shapes[0].ribbons[2]".into(), ..Place::file("l.json") };
/// assert_eq!(place.to_string(), "l.json:7: shapes[0].ribbons[2]");
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Place {
    /// The file's name as the caller gave it.
    pub file: String,
    /// Line, if it is known.
    pub line: Option<usize>,
    /// Column, if it is known.
    pub column: Option<usize>,
    /// The path from the root of a JSON document, like `shapes[0].ribbons[2]`; empty elsewhere.
    pub path: String,
}

impl Place {
    /// A file as a whole.
    pub fn file(name: impl Into<String>) -> Self {
        Self { file: name.into(), ..Self::default() }
    }

    /// A line of a file.
    pub fn line(name: impl Into<String>, line: usize) -> Self {
        Self { line: Some(line), ..Self::file(name) }
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.file)?;
        if let Some(line) = self.line {
            write!(f, ":{line}")?;
            if let Some(column) = self.column {
                write!(f, ":{column}")?;
            }
        }
        if !self.path.is_empty() {
            write!(f, ": {}", self.path)?;
        }
        Ok(())
    }
}

/// `shapes[0].ribbons[2]` from its steps.
pub(crate) fn path_text(steps: &[Step]) -> String {
    use fmt::Write;
    let mut text = String::new();
    for step in steps {
        // Writing to a string cannot fail.
        let _ = match step {
            Step::Field(name) if text.is_empty() => write!(text, "{name}"),
            Step::Field(name) => write!(text, ".{name}"),
            Step::Index(index) => write!(text, "[{index}]"),
        };
    }
    text
}

/// A piece of a file for a message: control characters escaped, at most 40 characters.
pub(crate) fn excerpt(text: &str) -> String {
    shorten(text, 40)
}

/// The first `limit` characters, control characters escaped.
pub(crate) fn shorten(text: &str, limit: usize) -> String {
    let mut short: String = text
        .chars()
        .take(limit)
        .flat_map(|c| if c.is_control() { c.escape_debug().collect() } else { vec![c] })
        .collect();
    if text.chars().nth(limit).is_some() {
        short.push('…');
    }
    short
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_and_excerpts() {
        let steps =
            [Step::Field("shapes"), Step::Index(3), Step::Field("domain"), Step::Index(0), Step::Index(1)];
        assert_eq!(path_text(&steps), "shapes[3].domain[0][1]");
        assert_eq!(excerpt("a\u{1}b"), "a\\u{1}b");
        assert_eq!(excerpt(&"é".repeat(50)), format!("{}…", "é".repeat(40)));
    }
}
