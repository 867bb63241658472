//! The house rules: which crate may use which, which files may name a library, no unsafe code.

use std::collections::BTreeSet;
use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

/// Every package with what it may use of this workspace, of spade and of glam; a row names only earlier rows.
/// Other libraries are free, and so are dev-dependencies.
#[rustfmt::skip]
const TABLE: &[(&str, &[&str])] = &[
    ("casteljau-bernstein", &["glam"]),
    ("casteljau-geom", &["glam"]),
    ("casteljau-mesh", &["casteljau-geom"]),
    ("casteljau-shape", &["casteljau-bernstein", "casteljau-geom"]),
    ("casteljau-solid", &["casteljau-bernstein", "casteljau-geom", "casteljau-shape"]),
    ("casteljau-domain", &["casteljau-geom", "spade"]),
    ("casteljau-gb", &["casteljau-bernstein", "casteljau-geom", "casteljau-shape", "casteljau-domain"]),
    ("casteljau-tess", &["casteljau-geom", "casteljau-mesh", "casteljau-shape", "casteljau-solid",
        "casteljau-domain", "casteljau-gb"]),
    ("casteljau-io", &["casteljau-geom", "casteljau-mesh", "casteljau-shape", "casteljau-solid", "casteljau-gb"]),
    ("casteljau-plot", &["casteljau-geom", "casteljau-mesh", "casteljau-shape", "casteljau-solid",
        "casteljau-domain", "casteljau-gb", "casteljau-tess"]),
    ("casteljau", &["casteljau-bernstein", "casteljau-geom", "casteljau-mesh", "casteljau-shape", "casteljau-solid",
        "casteljau-domain", "casteljau-gb", "casteljau-tess", "casteljau-io", "casteljau-plot"]),
    ("casteljau-capi", &["casteljau"]),
    ("casteljau-studio", &["casteljau"]),
    ("casteljau-cli", &["casteljau", "casteljau-studio"]),
    ("casteljau-benches", &[]),
];

/// Rows of packages that are still to come.
const ABSENT: &[&str] = &["casteljau-capi", "casteljau-studio"];

/// Libraries that stay behind one wall, with the files or folders of `crates/` whose code may name them.
const WALLS: &[(&[&str], &[&str])] = &[
    (&["spade"], &["domain/src/triangulation.rs"]),
    (&["faer"], &["domain/src/coordinates/harmonic/solve.rs", "domain/src/layout/projection.rs"]),
    (&["serde", "serde_json", "serde_path_to_error"], &["io/src/model/", "cli/src/"]),
];

type Outcome = Result<(), Box<dyn Error>>;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// The packages of the workspace, as `cargo metadata` lists them.
fn packages() -> Result<Vec<Value>, Box<dyn Error>> {
    let output = Command::new(env!("CARGO"))
        .args(["metadata", "--no-deps", "--offline", "--format-version", "1", "--manifest-path"])
        .arg(root().join("Cargo.toml"))
        .output()?;
    if !output.status.success() {
        return Err(String::from_utf8_lossy(&output.stderr).into());
    }
    let metadata: Value = serde_json::from_slice(&output.stdout)?;
    Ok(metadata["packages"].as_array().ok_or("no packages")?.clone())
}

/// What is wrong with one package, in words.
fn violations(package: &Value) -> Vec<String> {
    let name = package["name"].as_str().unwrap_or("?");
    let Some((_, row)) = TABLE.iter().find(|(row, _)| *row == name) else {
        return vec![format!("{name} has no row in the table")];
    };
    let dependencies = package["dependencies"].as_array().map_or(&[][..], Vec::as_slice);
    let normal = dependencies.iter().filter(|d| d["kind"] != "dev");
    normal
        .filter_map(|d| d["name"].as_str())
        .filter(|used| *used == "glam" || *used == "spade" || used.starts_with("casteljau"))
        .filter(|used| !row.contains(used))
        .map(|used| format!("{name} may not use {used}"))
        .collect()
}

#[test]
fn packages_use_only_what_their_rows_name() -> Outcome {
    let packages = packages()?;
    let found: Vec<String> = packages.iter().flat_map(violations).collect();
    assert!(found.is_empty(), "{found:#?}");
    let present: BTreeSet<&str> = packages.iter().filter_map(|p| p["name"].as_str()).collect();
    let expected = TABLE.iter().map(|(name, _)| *name).filter(|name| !ABSENT.contains(name)).collect();
    assert_eq!(present, expected, "packages and rows that are not listed as absent");
    Ok(())
}

#[test]
fn the_table_flows_one_way() {
    for (at, (name, row)) in TABLE.iter().enumerate() {
        for used in row.iter().filter(|used| used.starts_with("casteljau")) {
            assert!(
                TABLE[..at].iter().any(|(earlier, _)| earlier == used),
                "{name} names {used}, a later row"
            );
        }
    }
}

#[test]
fn a_stranger_a_shortcut_and_a_build_dependency_are_found() {
    let package = |name: &str, used: &str, kind: Value| {
        violations(&serde_json::json!({"name": name, "dependencies": [{"name": used, "kind": kind}]}))
    };
    assert_eq!(package("casteljau-new", "glam", Value::Null), ["casteljau-new has no row in the table"]);
    assert_eq!(
        package("casteljau-mesh", "casteljau-gb", Value::Null),
        ["casteljau-mesh may not use casteljau-gb"]
    );
    assert_eq!(package("casteljau-tess", "spade", Value::Null), ["casteljau-tess may not use spade"]);
    assert_eq!(
        package("casteljau-geom", "casteljau", "build".into()),
        ["casteljau-geom may not use casteljau"]
    );
    assert!(package("casteljau-geom", "casteljau", "dev".into()).is_empty());
    assert!(package("casteljau-gb", "casteljau-domain", Value::Null).is_empty());
}

/// Rust files below a folder.
fn sources(folder: &Path, into: &mut Vec<PathBuf>) -> std::io::Result<()> {
    for entry in std::fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() {
            sources(&path, into)?;
        } else if path.extension().is_some_and(|ending| ending == "rs") {
            into.push(path);
        }
    }
    Ok(())
}

/// Whether a line of code has the identifier; what follows `//` is no code.
fn names(line: &str, library: &str) -> bool {
    let code = line.split("//").next().unwrap_or_default();
    code.split(|c: char| !c.is_alphanumeric() && c != '_').any(|word| word == library)
}

#[test]
fn libraries_are_named_in_their_own_files_only() -> Outcome {
    let crates = root().join("crates");
    let mut inside = BTreeSet::new();
    for entry in std::fs::read_dir(&crates)? {
        let mut files = Vec::new();
        sources(&entry?.path().join("src"), &mut files)?;
        for file in files {
            let place = file.strip_prefix(&crates)?.to_string_lossy().replace('\\', "/");
            let text = std::fs::read_to_string(&file)?;
            for (libraries, walls) in WALLS {
                let wall = walls.iter().find(|wall| place.starts_with(**wall));
                for (number, line) in text.lines().enumerate() {
                    if let Some(library) = libraries.iter().find(|library| names(line, library)) {
                        assert!(wall.is_some(), "{place}:{}: names {library}", number + 1);
                        inside.extend(wall);
                    }
                }
            }
        }
    }
    let walls = WALLS.iter().flat_map(|(_, walls)| walls.iter()).collect();
    assert_eq!(inside, walls, "every place on the list is used");
    Ok(())
}

#[test]
fn names_are_whole_words_of_code() {
    assert!(names("use spade::handles::InnerTag;", "spade") && names("    #[serde(default)]", "serde"));
    assert!(!names("let spades = 4; // spade", "spade") && !names("use serde_json::Value;", "serde"));
}

/// The lines of a manifest's table.
fn section<'a>(manifest: &'a str, header: &'a str) -> impl Iterator<Item = &'a str> {
    manifest.lines().skip_while(move |line| *line != header).skip(1).take_while(|line| !line.starts_with('['))
}

#[test]
fn unsafe_code_is_forbidden_everywhere() -> Outcome {
    let manifest = std::fs::read_to_string(root().join("Cargo.toml"))?;
    assert!(section(&manifest, "[workspace.lints.rust]").any(|line| line == r#"unsafe_code = "forbid""#));
    for package in packages()? {
        let path = package["manifest_path"].as_str().ok_or("no manifest")?;
        let manifest = std::fs::read_to_string(path)?;
        assert!(section(&manifest, "[lints]").any(|line| line == "workspace = true"), "{path}");
    }
    Ok(())
}
