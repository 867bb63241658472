//! Parameters from the command line or from a file.

use std::fs::File;
use std::io::{BufRead, BufReader};

use casteljau::glam::DVec2;

use crate::arguments::{Places, Selection};
use crate::failure::Failure;
use crate::input::{STANDARD_INPUT, cannot_read, is_dash};

/// All parameters, in order.
pub fn read(places: &Places, selection: &Selection) -> Result<Vec<DVec2>, Failure> {
    let Some(path) = &places.params else {
        let parse = |text: &String| parse(text).map_err(|why| Failure::Usage(format!("--at {text}: {why}")));
        return places.at.iter().map(parse).collect();
    };
    if !is_dash(path) {
        let name = path.display().to_string();
        let file = File::open(path).map_err(|error| cannot_read(&name, &error))?;
        return lines(BufReader::new(file), &name);
    }
    if is_dash(&selection.model) {
        return Err(Failure::Usage("the model and --params cannot both be standard input".into()));
    }
    lines(std::io::stdin().lock(), STANDARD_INPUT)
}

/// One parameter a line; blank lines are no parameters.
fn lines(input: impl BufRead, name: &str) -> Result<Vec<DVec2>, Failure> {
    let mut parameters = Vec::new();
    for (index, line) in input.lines().enumerate() {
        let number = index + 1;
        let line = line.map_err(|error| Failure::Bad(format!("{name}:{number}: cannot read: {error}")))?;
        if line.trim().is_empty() {
            continue;
        }
        let parameter = parse(&line).map_err(|why| {
            let short: String = line.trim().chars().take(40).flat_map(char::escape_debug).collect();
            Failure::Bad(format!("{name}:{number}: `{short}`: {why}"))
        })?;
        parameters.push(parameter);
    }
    Ok(parameters)
}

fn parse(text: &str) -> Result<DVec2, String> {
    let mut numbers = [0.0; 2];
    let mut count = 0;
    for word in text.split(',') {
        let value: f64 = word.trim().parse().map_err(|_| "expected two numbers, u,v".to_string())?;
        if !value.is_finite() {
            return Err(format!("{value} is not finite"));
        }
        if let Some(slot) = numbers.get_mut(count) {
            *slot = value;
        }
        count += 1;
    }
    if count == 2 { Ok(DVec2::from(numbers)) } else { Err(format!("expected two numbers, u,v, not {count}")) }
}
