//! Whatever is wrong: a message with file and line, status 1 (or 2 for the command line), no panic, no half file.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod support;

use std::process::{Command, Stdio};

use serde_json::{Value, json};
use support::{casteljau, file, model, path, shared_models, with_input};

/// The L, with something changed.
fn l(change: impl FnOnce(&mut Value)) -> Vec<u8> {
    let mut value: Value = serde_json::from_str(&std::fs::read_to_string(model("l.json")).unwrap()).unwrap();
    change(&mut value["shapes"][0]);
    value.to_string().into_bytes()
}

const COMMANDS: [&[&str]; 5] =
    [&["info"], &["eval", "--at", "0,0"], &["domain"], &["check"], &["mesh", "-o", "-"]];

/// All commands refuse the content, naming the file, with these words.
#[track_caller]
fn refused(name: &str, content: &[u8], words: &[&str]) {
    let (_folder, file) = file(name, content);
    for command in COMMANDS {
        let run = casteljau(&[command, &[file.as_str()]].concat()).bad(1, words);
        assert!(run.err.contains(&format!("error: {file}")), "{}", run.err);
        assert!(run.out.is_empty(), "{command:?}: {}", run.out);
    }
}

#[test]
fn files_that_are_no_models() {
    refused("empty.json", b"", &["empty"]);
    refused("empty.cgb", b"", &["empty"]);
    refused("binary.json", b"\x89PNG\r\n\x1a\n\0\0", &["not a text file"]);
    let whole = l(|_| {});
    refused("truncated.json", &whole[..whole.len() / 2], &[":1:", "EOF"]);
    refused("other.json", b"[1, 2]", &["expected an object"]);
    refused(
        "kind.json",
        br#"{"casteljau": 1, "shapes": [{"kind": "rotational_solid"}]}"#,
        &["shapes[0]", "missing field `curve`"],
    );
    refused(
        "kind.json",
        br#"{"casteljau": 1, "shapes": [{"kind": "nurbs"}]}"#,
        &["there is no kind `nurbs`"],
    );
    refused("none.json", br#"{"casteljau": 1, "shapes": []}"#, &["no shapes"]);
    refused("part.step", b"ISO-10303-21;", &["the ending `step` is not known"]);
    refused("cells.vtu", b"<VTKFile type=\"PolyData\" version=\"2.2\"/>", &[":1: ", "PolyData"]);
    refused("patch.gbp", b"5 3", &[".gbp is not supported yet"]);
    refused("many.cgb", b"0 1 0.2 0\n1000000000\n0 0 0\n3 2\n", &[":2: ", "1000000000 sides are promised"]);
}

#[test]
fn nets_that_are_no_patches() {
    let points = |side: usize, k: usize, j: usize| format!("/ribbons/{side}/control_points/{k}/{j}");
    let set = |at: String, value: Value| l(move |shape| *shape.pointer_mut(&at).unwrap() = value);
    refused("row.json", &set(points(1, 1, 3), json!([1, 2])), &["ribbons[1].control_points[1][3]"]);
    refused(
        "short.json",
        &l(|s| drop(s["ribbons"][3]["control_points"][1].as_array_mut().unwrap().pop())),
        &["side 3", "row 1 has 3 control points"],
    );
    refused(
        "nan.json",
        &String::from_utf8(l(|_| {})).unwrap().replacen("0.0", "NaN", 1).into_bytes(),
        &["shapes[0].ribbons"],
    );
    refused(
        "huge.json",
        &set(points(0, 1, 1), json!([1e300, 0, 0])),
        &["side 0", "1e300"].map(|w| if w == "1e300" { "exceeds 1e70" } else { w }),
    );
    refused(
        "gap.json",
        &set(points(2, 0, 0), json!([80, 40, 99])),
        &["side 1 ends", "away from the start of side 2"],
    );
    refused(
        "point.json",
        &set("/ribbons/4/control_points/0".into(), json!([[0, 88, 0]])),
        &["side 4", "degree 0"],
    );
    refused("layers.json", &set("/ribbons/2/control_points".into(), json!([])), &["side 2", "0 layers"]);
    refused("power.json", &l(|s| s["blend_power"] = json!(-2)), &["blend_power"]);
    let crossing = json!([[0, 0], [2, 2], [2, 0], [0, 2], [-1, 3], [-1, -1]]);
    refused(
        "crossing.json",
        &l(|s| {
            s["domain"] = crossing;
            s.as_object_mut().unwrap().remove("layout");
        }),
        &["shapes[0].domain", "sides"],
    );
    // Corner 3 is moved to where corner 5 is, on both sides that have it.
    let equal = l(|s| {
        let corner = s["ribbons"][5]["control_points"][0][3].clone();
        s["ribbons"][3]["control_points"][0][3] = corner.clone();
        s["ribbons"][4]["control_points"][0][0] = corner;
    });
    refused("equal.json", &equal, &["corners 3 and 5 are"]);
    let flat = l(|s| {
        let start = s["ribbons"][1]["control_points"][0][0].clone();
        for j in 0..4 {
            s["ribbons"][1]["control_points"][0][j] = start.clone();
        }
    });
    refused("flat.json", &flat, &["side 1 has zero length"]);
}

#[test]
fn a_patch_of_numbers_alone() {
    let triangle = "1 0\n0.2 0\n3\n0 0 0\n1 1 0 0 0 1 0 0\n1 1 1 0 0 0 1 0\n1 1 0 1 0 0 0 0\n";
    let (_folder, name) = file("whole.cgb", triangle.as_bytes());
    casteljau(&["info", &name]).good();
    let with = |line: &str, instead: &str| triangle.replacen(line, instead, 1);
    refused("degree.cgb", with("1 1 1 0 0", "-1 1 1 0 0").as_bytes(), &[":6: side 1: degree -1"]);
    refused("gap.cgb", with("1 1 1 0 0", "1 1 1 0.5 0").as_bytes(), &[":6: side 0 ends"]);
    refused("nan.cgb", with("0 1 0 0\n", "0 1 nan 0\n").as_bytes(), &[":5: side 0", "not finite"]);
    refused("cut.cgb", &triangle.as_bytes()[..triangle.len() - 8], &[":3: 3 sides are promised"]);
    refused("dilated.cgb", with("0.2 0", "0.2 0.1").as_bytes(), &[":2: a dilation of 0.1"]);
    // What is no fault of a ribbon is placed where the patch begins.
    refused("weight.cgb", with("1 0", "2 0").as_bytes(), &[":1: center_weight"]);
}

#[test]
fn damaged_published_models() {
    let Some(folder) = shared_models() else { return };
    let text = std::fs::read_to_string(folder.join("L.cgb")).unwrap();
    refused("half.cgb", &text.as_bytes()[..text.len() / 2], &["the file ends where"]);
    refused("word.cgb", text.replacen('.', "x", 3).as_bytes(), &[":"]);
}

#[test]
fn files_that_cannot_be_read_or_written() {
    casteljau(&["info", "/nowhere/l.json"]).bad(1, &["/nowhere/l.json: cannot read"]);
    let folder = tempfile::tempdir().unwrap();
    let name = path(folder.path());
    casteljau(&["info", &name]).bad(1, &[&name]);
    casteljau(&["eval", &model("l.json"), "--params", &name]).bad(1, &[&name, "cannot read"]);
    casteljau(&["mesh", &model("l.json"), "-o", "/nowhere/l.obj", "--resolution", "4"])
        .bad(1, &["/nowhere/l.obj: cannot"]);
    casteljau(&["plot", &model("l.json"), "-o", "/nowhere/l.svg", "--triangles", "100"])
        .bad(1, &["/nowhere/l.svg: cannot"]);
    let directory = path(&folder.path().join("folder.svg"));
    std::fs::create_dir(&directory).unwrap();
    casteljau(&["plot", &model("l.json"), "-o", &directory, "--triangles", "100"])
        .bad(1, &["folder.svg: cannot write"]);
    for (command, out) in [("mesh", "l.step"), ("mesh", "l"), ("plot", "l.jpg"), ("plot", "l")] {
        casteljau(&[command, &model("l.json"), "-o", out]).bad(1, &[out, "is not known"]);
    }
    casteljau(&["plot", &model("l.json"), "-o", "l.png"])
        .bad(1, &["l.png", ".png are not supported yet", "svg"]);
    assert!(!std::path::Path::new("l.png").exists());
}

#[test]
fn an_older_file_survives_what_goes_wrong() {
    let (folder, out) = file("l.obj", b"mine");
    casteljau(&["mesh", &model("l.json"), "-o", &out, "--tolerance", "0"]).bad(2, &["--tolerance"]);
    casteljau(&["mesh", &model("l.json"), "-o", &out, "--tolerance", "1e-6", "--max-vertices", "1000"])
        .bad(1, &["1000 are allowed"]);
    assert_eq!(std::fs::read(&out).unwrap(), b"mine");
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
}

#[test]
fn parameters_that_are_none() {
    let l = model("l.json");
    for (list, words) in [
        ("0,0\n1,2,3\n", ":2: "),
        ("a,b\n", ":1: "),
        ("0.1,nan\n", ":1: "),
        ("0.1\n", ":1: "),
        ("0;0\n", ":1: "),
    ] {
        let (_folder, name) = file("params.csv", list.as_bytes());
        let run = casteljau(&["eval", &l, "--json", "--params", &name]).bad(1, &[&name, words]);
        assert!(run.out.is_empty());
    }
    let (_folder, name) = file("params.csv", b"\xff\xfe");
    casteljau(&["eval", &l, "--params", &name]).bad(1, &[&name, ":1: "]);
}

#[test]
fn command_lines_that_make_no_sense() {
    let l = model("l.json");
    for arguments in [
        &["eval", &l] as &[&str],
        &["eval", &l, "--at", "1"],
        &["eval", &l, "--at", "x,y"],
        &["eval", &l, "--at", "inf,0"],
        &["eval", &l, "--at", "0,0", "--params", "file"],
        &["eval", &l, "--at", "0,0", "--order", "3"],
        &["mesh", &l],
        &["mesh", &l, "-o", "-", "--tolerance", "1", "--resolution", "2"],
        &["check", &l, "--angle", "nan"],
        &["check", &l, "--samples", "0"],
        &["plot", &l, "-o", "-", "--view", "sideways"],
        &["plot", &l, "-o", "-", "--isolines", "x"],
        &["frobnicate"],
    ] {
        assert_eq!(casteljau(arguments).status, 2, "{arguments:?}");
    }
    assert_eq!(casteljau(&[]).status, 2);
    assert_eq!(casteljau(&["--help"]).good().status, 0);
    casteljau(&["--version"]).good();
    casteljau(&["eval", &l, "--shape", "1", "--at", "0,0"]).bad(1, &["there is no shape 1", "has 1 shape"]);
    casteljau(&["plot", &l, "-o", "-", "--isolines", "6"]).bad(1, &["there is no side 6"]);
    casteljau(&["plot", &l, "-o", "-", "--domain", "--coordinate", "6"])
        .bad(1, &["there is no coordinate 6"]);
    casteljau(&["plot", &l, "-o", "-", "--triangles", "1000000000"]).bad(2, &["number of triangles"]);
    casteljau(&["mesh", &l, "-o", "-", "--resolution", "1000000000"]).bad(1, &["l.json"]);
    casteljau(&["mesh", &l, "-o", "-", "--resolution", "0"]).bad(2, &["--resolution"]);
    for wrong in ["-1", "0", "nan", "inf"] {
        casteljau(&["mesh", &l, "-o", "-", "--tolerance", wrong]).bad(2, &["--tolerance"]);
    }
    for wrong in ["-1", "0", "nan", "inf", "2", "1e-13"] {
        let accuracy = format!("--accuracy={wrong}");
        casteljau(&["info", &l, &accuracy]).bad(2, &["--accuracy"]);
    }
}

#[test]
fn every_beginning_of_a_model_is_refused_in_peace() {
    let whole = l(|_| {});
    for length in (0..whole.len()).step_by(whole.len() / 40) {
        with_input(&["info", "-"], &whole[..length]).bad(1, &["standard input"]);
    }
}

#[test]
fn a_reader_that_goes_away_is_no_error() {
    let mut child = Command::new(env!("CARGO_BIN_EXE_casteljau"))
        .args(["mesh", &model("l.json"), "-o", "-", "--resolution", "64"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert!(
        output.stderr.is_empty() && output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
}

#[cfg(unix)]
#[test]
fn a_signal_leaves_no_half_file() {
    let folder = tempfile::tempdir().unwrap();
    let out = path(&folder.path().join("fine.stl"));
    for wait in [5, 50, 300] {
        let mut child = Command::new(env!("CARGO_BIN_EXE_casteljau"))
            .args(["mesh", &model("closed.json"), "-o", &out, "--resolution", "300"])
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        std::thread::sleep(std::time::Duration::from_millis(wait));
        assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
        let status = child.wait().unwrap();
        assert!(status.code().is_some_and(|code| code == 130 || code == 0) || wait == 5, "{status:?}");
        let left: Vec<_> = std::fs::read_dir(folder.path()).unwrap().map(|f| f.unwrap().path()).collect();
        assert!(status.success() || left.is_empty(), "{left:?}");
    }
}
