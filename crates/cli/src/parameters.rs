//! Parameters from the command line or from a file.

use std::fs::File;
use std::io::{BufRead, BufReader};

use crate::arguments::{Places, Selection};
use crate::failure::Failure;
use crate::input::{STANDARD_INPUT, cannot_read, is_dash};

/// The most numbers that a parameter has, those of a solid.
const MOST: usize = 3;

/// What a shape takes.
#[derive(Clone, Copy, PartialEq)]
pub struct Wanted {
    /// How many numbers.
    pub count: usize,
    /// How a person calls them.
    pub words: &'static str,
}

impl Wanted {
    pub const CURVE: Self = Self { count: 1, words: "one number, t" };
    pub const SURFACE: Self = Self { count: 2, words: "two numbers, u,v" };
    pub const TRIANGLE: Self = Self { count: 2, words: "two numbers, λ1,λ2" };
    pub const BOX: Self = Self { count: 3, words: "three numbers, u,v,w" };
    pub const TETRAHEDRON: Self = Self { count: 3, words: "three numbers, λ1,λ2,λ3" };
    pub const WEDGE: Self = Self { count: 3, words: "three numbers, λ1,λ2,w" };
}

/// A parameter, and the line that it stands on.
#[derive(Clone, Copy)]
pub struct Parameter {
    numbers: [f64; MOST],
    count: usize,
    line: usize,
}

impl Parameter {
    pub fn numbers(&self) -> &[f64] {
        &self.numbers[..self.count]
    }
}

/// All parameters, in order.
pub struct Parameters {
    pub all: Vec<Parameter>,
    /// The file that they come from; none for the command line.
    file: Option<String>,
}

impl Parameters {
    pub fn read(places: &Places, selection: &Selection) -> Result<Self, Failure> {
        let Some(path) = &places.params else {
            let parse = |(index, text): (usize, &String)| {
                parse(text, index).map_err(|why| Failure::Usage(format!("--at {text}: {why}")))
            };
            let all = places.at.iter().enumerate().map(parse).collect::<Result<_, _>>()?;
            return Ok(Self { all, file: None });
        };
        if !is_dash(path) {
            let name = path.display().to_string();
            let file = File::open(path).map_err(|error| cannot_read(&name, &error))?;
            return Self::lines(BufReader::new(file), name);
        }
        if is_dash(&selection.model) {
            return Err(Failure::Usage("the model and --params cannot both be standard input".into()));
        }
        Self::lines(std::io::stdin().lock(), STANDARD_INPUT.into())
    }

    /// One parameter a line; blank lines are no parameters.
    fn lines(input: impl BufRead, name: String) -> Result<Self, Failure> {
        let mut all = Vec::new();
        for (index, line) in input.lines().enumerate() {
            let number = index + 1;
            let line =
                line.map_err(|error| Failure::Bad(format!("{name}:{number}: cannot read: {error}")))?;
            if line.trim().is_empty() {
                continue;
            }
            let parameter = parse(&line, number).map_err(|why| {
                let short: String = line.trim().chars().take(40).flat_map(char::escape_debug).collect();
                Failure::Bad(format!("{name}:{number}: `{short}`: {why}"))
            })?;
            all.push(parameter);
        }
        Ok(Self { all, file: Some(name) })
    }

    /// Refuses a parameter that none of the shapes takes.
    pub fn check(&self, wanted: &[Wanted]) -> Result<(), Failure> {
        let fits = |parameter: &Parameter| wanted.iter().any(|w| w.count == parameter.count);
        let Some(stranger) = self.all.iter().find(|p| !fits(p)) else { return Ok(()) };
        let mut words: Vec<&str> = Vec::new();
        for w in wanted {
            if !words.contains(&w.words) {
                words.push(w.words);
            }
        }
        let expected = format!("expected {}, not {}", words.join(" or "), stranger.count);
        let numbers: Vec<String> = stranger.numbers().iter().map(f64::to_string).collect();
        let numbers = numbers.join(",");
        Err(match &self.file {
            Some(file) => Failure::Bad(format!("{file}:{}: `{numbers}`: {expected}", stranger.line)),
            None => Failure::Usage(format!("--at {numbers}: {expected}")),
        })
    }
}

/// The numbers of one parameter, with commas between them.
pub fn numbers(text: &str) -> Result<Vec<f64>, String> {
    parse(text, 0).map(|parameter| parameter.numbers().to_vec())
}

fn parse(text: &str, line: usize) -> Result<Parameter, String> {
    let mut parameter = Parameter { numbers: [0.0; MOST], count: 0, line };
    for word in text.split(',') {
        let value: f64 =
            word.trim().parse().map_err(|_| "expected numbers with commas between them".to_string())?;
        if !value.is_finite() {
            return Err(format!("{value} is not finite"));
        }
        let Some(slot) = parameter.numbers.get_mut(parameter.count) else {
            return Err(format!("more than {MOST} numbers"));
        };
        *slot = value;
        parameter.count += 1;
    }
    Ok(parameter)
}
