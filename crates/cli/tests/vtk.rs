//! VTK reads and evaluates our files, and we read VTK's: `vtk_reads_our_files.py`, where Python and the wheel `vtk` can be had.
#![allow(clippy::unwrap_used, clippy::panic)]

use std::path::Path;
use std::process::Command;

/// `CASTELJAU_PYTHON` names the interpreter that has the wheel; otherwise `python3` is tried.
#[test]
fn vtk_agrees() {
    let python = std::env::var("CASTELJAU_PYTHON").unwrap_or_else(|_| "python3".into());
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let scratch = tempfile::tempdir().unwrap();
    let run = Command::new(&python)
        .arg(here.join("tests/vtk_reads_our_files.py"))
        .arg(env!("CARGO_BIN_EXE_casteljau"))
        .arg(here.join("../../models"))
        .arg(scratch.path())
        .output();
    let run = match run {
        Ok(run) => run,
        Err(error) => {
            println!("NOT TESTED AGAINST VTK: {python} cannot be run: {error}");
            return;
        }
    };
    let said = format!("{}{}", String::from_utf8_lossy(&run.stdout), String::from_utf8_lossy(&run.stderr));
    match run.status.code() {
        Some(0) => println!("{said}"),
        Some(77) => println!("NOT TESTED AGAINST VTK: {python} has no wheel `vtk`: {said}"),
        _ => panic!("{said}"),
    }
}
