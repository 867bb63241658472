//! Every bad file in `cases/` is refused with the message beside it, which says where and what.
#![allow(clippy::unwrap_used, clippy::panic, clippy::unreachable)]

use std::fs;
use std::path::Path;

use casteljau_io::{IoError, MAX_FILE_BYTES, Reason, read_model_bytes, read_model_file};

/// Reads a file and builds its shapes.
fn open(path: &Path) -> Result<(), IoError> {
    let (model, _) = read_model_file(path)?;
    model.shapes.iter().try_for_each(|shape| shape.to_geometry().map(drop))
}

#[test]
fn every_case_is_refused_as_expected() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cases");
    let mut paths: Vec<_> = fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.retain(|path| path.extension().unwrap() != "expected");
    paths.sort();
    assert!(paths.len() >= 200, "{} cases", paths.len());
    let mut wrong = String::new();
    for path in paths {
        let expected = fs::read_to_string(path.with_extension("expected")).unwrap();
        let expected = expected.trim_end().replace("FILE", &path.display().to_string());
        let message = match open(&path) {
            Ok(()) => "no error".into(),
            Err(error) => error.to_string(),
        };
        let named = message.starts_with(&path.display().to_string());
        if !named || !message.contains(&expected) || message.contains('\n') {
            wrong += &format!("{message}\n  expected: {expected}\n");
        }
    }
    assert!(wrong.is_empty(), "\n{wrong}");
}

#[test]
fn files_that_are_not_there_or_not_files() {
    let missing = open(Path::new("/no/such/file.json")).unwrap_err().to_string();
    assert!(missing.starts_with("/no/such/file.json: cannot read: "), "{missing}");
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.json");
    fs::create_dir(&path).unwrap();
    assert!(matches!(open(&path), Err(IoError::System { action: "read", .. })));
    for (name, part) in [
        ("a.gbp", ".gbp is not supported yet; supported: json, cgb, vtu"),
        ("a.stp", "known endings"),
        ("a", "``"),
    ] {
        let message = open(&folder.path().join(name)).unwrap_err().to_string();
        assert!(message.contains(name) && message.contains(part), "{message}");
    }
}

#[test]
fn a_file_that_is_too_long_is_not_read() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("long.cgb");
    // Sparse: takes no room on the disk.
    fs::File::create(&path).unwrap().set_len(MAX_FILE_BYTES + 1).unwrap();
    assert!(matches!(open(&path), Err(IoError::Invalid { reason: Reason::TooLong { .. }, .. })));
}

#[test]
fn nesting_of_any_depth_ends_in_an_error() {
    let deep = 1_000_000;
    for text in [
        "[".repeat(deep),
        "{\"a\":".repeat(deep),
        format!("{{\"casteljau\": 1, \"shapes\": [], \"x\": {}", "[".repeat(deep)),
        format!("{{\"casteljau\": 1, \"shapes\": [], \"x\": {}{}}}", "[".repeat(deep), "]".repeat(deep)),
        format!("{{\"casteljau\": 1, \"shapes\": {}", "[".repeat(deep)),
    ] {
        let message = read_model_bytes(text.as_bytes(), "deep.json", None).unwrap_err().to_string();
        assert!(message.starts_with("deep.json:1:") && message.len() < 400, "{message}");
    }
    for text in ["<a>".repeat(deep), "<a>".repeat(deep) + &"</a>".repeat(deep)] {
        let message = read_model_bytes(text.as_bytes(), "deep.vtu", None).unwrap_err().to_string();
        assert!(message.starts_with("deep.vtu:1:") && message.len() < 400, "{message}");
    }
}
