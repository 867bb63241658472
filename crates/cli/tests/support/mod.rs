//! Runs the program as its users do.
#![allow(dead_code)]

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use serde_json::Value;

/// What a run left behind.
pub struct Outcome {
    pub status: i32,
    pub out: String,
    pub err: String,
}

impl Outcome {
    /// Every line of standard output, which must all be JSON objects.
    pub fn json(&self) -> Vec<Value> {
        let parse = |line: &str| match serde_json::from_str::<Value>(line) {
            Ok(value) if value.is_object() => value,
            other => panic!("`{line}` is {other:?}"),
        };
        self.out.lines().map(parse).collect()
    }

    /// Fails unless the run succeeded without a word on standard error.
    #[track_caller]
    pub fn good(self) -> Self {
        assert!(self.status == 0 && self.err.is_empty(), "status {}: {}", self.status, self.err);
        self
    }

    /// Fails unless the run ended with this status and one line `error: …` that holds all the words.
    #[track_caller]
    pub fn bad(self, status: i32, words: &[&str]) -> Self {
        assert_eq!(self.status, status, "{}{}", self.out, self.err);
        let errors: Vec<&str> = self.err.lines().filter(|line| line.starts_with("error: ")).collect();
        assert_eq!(errors.len(), 1, "{}", self.err);
        for word in words {
            assert!(errors[0].contains(word), "`{word}` is not in `{}`", errors[0]);
        }
        self
    }
}

pub fn casteljau(arguments: &[&str]) -> Outcome {
    with_input(arguments, b"")
}

/// Runs with standard input. Whatever happens, nobody must ever see a panic.
pub fn with_input(arguments: &[&str], input: &[u8]) -> Outcome {
    let mut child = Command::new(env!("CARGO_BIN_EXE_casteljau"))
        .args(arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut pipe = child.stdin.take().unwrap();
    let input = input.to_vec();
    // Who does not read its input must not stop the test.
    let writer = std::thread::spawn(move || drop(pipe.write_all(&input)));
    let output = child.wait_with_output().unwrap();
    writer.join().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    let (out, err) = (text(output.stdout), text(output.stderr));
    assert!(!err.contains("panicked"), "{arguments:?}: {err}");
    Outcome { status: output.status.code().expect("ended by a signal"), out, err }
}

/// One of our sample models.
pub fn model(name: &str) -> String {
    path(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../../models").join(name))
}

pub const MODELS: [&str; 6] = ["l.json", "u.json", "pocket.json", "mixed.json", "pair.json", "closed.json"];

/// The shared models, where they are.
pub fn shared_models() -> Option<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/models");
    if !folder.is_dir() {
        println!("the shared models are absent: nothing to check");
        return None;
    }
    Some(folder)
}

pub fn path(path: &Path) -> String {
    path.to_str().unwrap().to_string()
}

/// A file in a folder of its own, which goes away with the first of the pair.
pub fn file(name: &str, content: &[u8]) -> (tempfile::TempDir, String) {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join(name);
    std::fs::write(&file, content).unwrap();
    let name = path(&file);
    (folder, name)
}

pub fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect()
}
