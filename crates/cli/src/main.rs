//! The program `casteljau`: reads a model, answers with text for a person or, with `--json`, one JSON object a line.
//!
//! Exit status: 0 done; 1 the input or the result is bad; 2 usage; 130 interrupted.

mod arguments;
mod check;
mod convert;
mod domain;
mod eval;
mod failure;
mod info;
mod input;
mod interrupt;
mod mesh;
mod number;
mod output;
mod parameters;
mod plot;
mod polylines;
mod progress;
mod words;

use std::process::ExitCode;

use arguments::{Arguments, Command};
use clap::Parser;
use failure::Failure;

fn main() -> ExitCode {
    let arguments = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(message) => {
            // Help goes to standard output, and its reader may be gone; there is nothing to be done about either.
            let _ = message.print();
            return if message.use_stderr() { ExitCode::from(2) } else { ExitCode::SUCCESS };
        }
    };
    interrupt::install();
    match run(&arguments) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.report(),
    }
}

fn run(arguments: &Arguments) -> Result<(), Failure> {
    let json = arguments.json;
    match &arguments.command {
        Command::Info(options) => info::run(options, json),
        Command::Eval(options) => eval::run(options, json),
        Command::Domain(options) => domain::run(options, json),
        Command::Mesh(options) => mesh::run(options, json),
        Command::Check(options) => check::run(options, json),
        Command::Convert(options) => convert::run(options),
        Command::Plot(options) => plot::run(options),
    }
}
