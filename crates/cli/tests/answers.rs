//! What the program answers about the sample models.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod support;

use serde_json::Value;
use support::{MODELS, casteljau, file, model, numbers, path, with_input};

fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| (x - y).powi(2)).sum::<f64>().sqrt()
}

/// The vertices and the middle of the domain of the L.
fn domain_of_l() -> (Vec<Vec<f64>>, [f64; 2]) {
    let line = casteljau(&["domain", &model("l.json"), "--json"]).good().json().remove(0);
    let vertices: Vec<Vec<f64>> = line["vertices"].as_array().unwrap().iter().map(numbers).collect();
    // Vertex 2 is the concave one, vertex 5 the one across.
    let inside = [0, 1].map(|axis| 0.5 * (vertices[2][axis] + vertices[5][axis]));
    (vertices, inside)
}

#[test]
fn info_tells_what_is_in_the_file() {
    for name in MODELS {
        let lines = casteljau(&["info", &model(name), "--json"]).good().json();
        let expected = match name {
            "closed.json" => 8,
            "pair.json" => 2,
            _ => 1,
        };
        assert_eq!(lines.len(), expected, "{name}");
        for (index, line) in lines.iter().enumerate() {
            assert_eq!(
                (line["shape"].as_u64(), line["kind"].as_str()),
                (Some(index as u64), Some("gb_patch"))
            );
            let sides = line["sides"].as_u64().unwrap() as usize;
            assert_eq!(line["degrees"].as_array().unwrap().len(), sides);
            assert_eq!(line["layers"].as_array().unwrap().len(), sides);
            assert!(line["area"].as_f64().unwrap() > 0.0 && line["volume"].is_null());
            let (low, high) = (numbers(&line["bounds"]["min"]), numbers(&line["bounds"]["max"]));
            assert!((0..3).all(|k| low[k] <= high[k]));
        }
        assert!(!casteljau(&["info", &model(name)]).good().out.is_empty());
    }
    // The bottom of the bracket is flat, the image of the L under (43u + 1.5v², 43v + 1.5u²): ∫ 43² − 9uv = 5531.25.
    let bottom =
        casteljau(&["info", &model("closed.json"), "--shape", "1", "--json"]).good().json().remove(0);
    let (area, error) = (bottom["area"].as_f64().unwrap(), bottom["area_error"].as_f64().unwrap());
    assert_eq!(bottom["shape"], 1);
    assert!((area - 5531.25).abs() < 0.2 && error < 0.2, "{area} ± {error}");
}

#[test]
fn eval_gives_points_derivatives_and_curvatures() {
    let (_, [u, v]) = domain_of_l();
    let at = format!("{u},{v}");
    let line =
        casteljau(&["eval", &model("l.json"), "--json", "--order", "2", "--at", &at]).good().json().remove(0);
    assert_eq!(numbers(&line["params"]), [u, v]);
    let partials = line["partials"].as_object().unwrap();
    assert_eq!(partials.len(), 6);
    assert_eq!(partials["0,0"], line["point"]);
    // Against central differences of the program's own points.
    let step = 1e-5;
    let shifted: Vec<String> = [(step, 0.0), (-step, 0.0), (0.0, step), (0.0, -step)]
        .map(|(a, b)| format!("{},{}", u + a, v + b))
        .into();
    let arguments: Vec<&str> = shifted.iter().flat_map(|at| ["--at", at.as_str()]).collect();
    let l = model("l.json");
    let near = casteljau(&[&["eval", &l, "--json"], &arguments[..]].concat()).good().json();
    assert!(near[0].get("partials").is_none());
    for (key, pair) in [("1,0", 0), ("0,1", 2)] {
        let (a, b) = (numbers(&near[pair]["point"]), numbers(&near[pair + 1]["point"]));
        let difference: Vec<f64> = a.iter().zip(&b).map(|(a, b)| (a - b) / (2.0 * step)).collect();
        let exact = numbers(&partials[key]);
        assert!(distance(&difference, &exact) < 1e-5 * distance(&exact, &[0.0; 3]), "{key}");
    }
    let normal = numbers(&line["normal"]);
    let dot = |key: &str| numbers(&partials[key]).iter().zip(&normal).map(|(a, b)| a * b).sum::<f64>();
    assert!(
        dot("1,0").abs() < 1e-10
            && dot("0,1").abs() < 1e-10
            && (distance(&normal, &[0.0; 3]) - 1.0).abs() < 1e-14
    );
    let principal = numbers(&line["principal"]);
    let (gaussian, mean) = (line["gaussian"].as_f64().unwrap(), line["mean"].as_f64().unwrap());
    assert!(
        (gaussian - principal[0] * principal[1]).abs() < 1e-12
            && (2.0 * mean - principal[0] - principal[1]).abs() < 1e-12
    );
    assert!((numbers(&line["barycentric"]).iter().sum::<f64>() - 1.0).abs() < 1e-12);
}

#[test]
fn corners_have_point_and_normal_and_the_rest_is_null() {
    let (vertices, _) = domain_of_l();
    let model_text: Value = serde_json::from_str(&std::fs::read_to_string(model("l.json")).unwrap()).unwrap();
    let at: Vec<String> = vertices.iter().map(|v| format!("{},{}", v[0], v[1])).collect();
    let arguments: Vec<&str> = at.iter().flat_map(|at| ["--at", at.as_str()]).collect();
    let l = model("l.json");
    let lines = casteljau(&[&["eval", &l, "--json", "--order", "1"], &arguments[..]].concat()).good().json();
    for (corner, line) in lines.iter().enumerate() {
        let row = &model_text["shapes"][0]["ribbons"][corner]["control_points"][0];
        assert_eq!(line["point"], row[3], "corner {corner}");
        assert!((distance(&numbers(&line["normal"]), &[0.0; 3]) - 1.0).abs() < 1e-14);
        for missing in ["gaussian", "mean", "principal"] {
            assert!(line[missing].is_null());
        }
        assert!(line["partials"]["1,0"].is_null() && line["partials"]["0,0"] == line["point"]);
        let expected: Vec<f64> = (0..6).map(|i| f64::from(i == corner)).collect();
        assert_eq!(numbers(&line["barycentric"]), expected);
    }
    let rows = casteljau(&[&["domain", &l, "--json"], &arguments[..]].concat()).good().json();
    assert!(rows[1..].iter().all(|row| row["du"].is_null() && row["dv"].is_null()));
}

#[test]
fn one_line_for_each_parameter_and_an_error_where_there_is_no_answer() {
    let (_, [u, v]) = domain_of_l();
    let list = format!("{u},{v}\n\n-100,0.5\n{u}, {v}\n1e300,1e300\n");
    let (_folder, params) = file("params.txt", list.as_bytes());
    let l = model("l.json");
    for command in ["eval", "domain"] {
        let run = casteljau(&[command, &l, "--json", "--params", &params]).bad(1, &["2 of 4 parameters"]);
        let lines = run.json();
        let lines = if command == "domain" { &lines[1..] } else { &lines[..] };
        assert_eq!(lines.len(), 4);
        assert_eq!(numbers(&lines[1]["params"]), [-100.0, 0.5]);
        for (line, good) in lines.iter().zip([true, false, true, false]) {
            assert_eq!(line.get("error").is_none(), good, "{line}");
            assert_eq!(line.get("barycentric").is_some(), good, "{line}");
        }
        assert!(lines[1]["error"].as_str().unwrap().contains("outside"));
    }
    let text = casteljau(&["eval", &l, "--params", &params]).bad(1, &["2 of 4"]);
    assert_eq!(text.out.matches("point  ").count(), 2);
}

#[test]
fn negative_parameters_of_every_spelling() {
    let (folder, moved) = file("square.json", SQUARE.as_bytes());
    let run =
        |arguments: &[&str]| casteljau(&[&["eval", &moved, "--json"], arguments].concat()).good().json();
    let lines = run(&["--at", "-0.25,0.5", "--at=-0.25,0.5", "--at", "-.25,5e-1"]);
    assert_eq!(lines.len(), 3);
    // The square is its own mirror image.
    let mirrored = numbers(&run(&["--at", "0.25,0.5"])[0]["point"]);
    for line in &lines {
        assert_eq!(numbers(&line["params"]), [-0.25, 0.5]);
        assert!(distance(&numbers(&line["point"]), &[-mirrored[0], mirrored[1], 0.0]) < 1e-14, "{line}");
        assert!(numbers(&line["normal"])[2] > 0.999_999);
    }
    drop(folder);
}

/// A flat square of side 2 about the origin, in its own plane.
const SQUARE: &str = r#"{"casteljau": 1, "shapes": [{"kind": "gb_patch", "domain": [[1, 1], [-1, 1], [-1, -1], [1, -1]],
"ribbons": [
  {"control_points": [[[1, -1, 0], [1, 1, 0]], [[-1, -1, 0], [-1, 1, 0]]]},
  {"control_points": [[[1, 1, 0], [-1, 1, 0]], [[1, -1, 0], [-1, -1, 0]]]},
  {"control_points": [[[-1, 1, 0], [-1, -1, 0]], [[1, 1, 0], [1, -1, 0]]]},
  {"control_points": [[[-1, -1, 0], [1, -1, 0]], [[-1, 1, 0], [1, 1, 0]]]}]}]}"#;

#[test]
fn a_clockwise_domain_changes_derivatives_and_nothing_else() {
    let (vertices, [u, v]) = domain_of_l();
    let text = std::fs::read_to_string(model("l.json")).unwrap();
    let answer = |mirror: f64| {
        let mut value: Value = serde_json::from_str(&text).unwrap();
        let shape = value["shapes"][0].as_object_mut().unwrap();
        shape.remove("layout");
        shape.insert("domain".into(), vertices.iter().map(|p| vec![mirror * p[0], p[1]]).collect());
        let (_folder, name) = file("l.json", value.to_string().as_bytes());
        let at = format!("{},{v}", mirror * u);
        casteljau(&["eval", &name, "--json", "--order", "1", "--at", &at]).good().json().remove(0)
    };
    let (one, other) = (answer(1.0), answer(-1.0));
    for key in ["point", "normal", "principal", "barycentric"] {
        assert!(distance(&numbers(&one[key]), &numbers(&other[key])) < 1e-6, "{key}: {one} {other}");
    }
    let difference = |key: &str| (one[key].as_f64().unwrap() - other[key].as_f64().unwrap()).abs();
    assert!(difference("mean") < 1e-7 && difference("gaussian") < 1e-7);
    assert!(one["mean"].as_f64().unwrap().abs() > 1e-3);
    let du = [&one, &other].map(|answer| numbers(&answer["partials"]["1,0"]));
    assert!(distance(&du[0], &du[1].iter().map(|x| -x).collect::<Vec<_>>()) < 1e-4);
}

#[test]
fn domain_describes_polygon_and_coordinates() {
    for name in MODELS {
        for line in casteljau(&["domain", &model(name), "--json"]).good().json() {
            let vertices = line["vertices"].as_array().unwrap().len();
            assert_eq!(line["concave"].as_array().unwrap().len(), vertices);
            assert!(line["boundary_residual"].as_f64().unwrap() <= 1e-8);
            assert!(["projection", "regular"].contains(&line["layout"].as_str().unwrap()));
            assert_eq!(line["coordinates"], "harmonic");
        }
        casteljau(&["domain", &model(name)]).good();
    }
    let (vertices, [u, v]) = domain_of_l();
    let at = format!("{u},{v}");
    let lines = casteljau(&["domain", &model("l.json"), "--json", "--at", &at]).good().json();
    assert_eq!(lines.len(), 2);
    assert_eq!(lines[0]["concave"], serde_json::json!([false, false, true, false, false, false]));
    // Linear precision: Σ λ_i v_i = (u, v), and the same for the derivatives.
    let moment = |row: &str, axis: usize| {
        numbers(&lines[1][row]).iter().zip(&vertices).map(|(l, v)| l * v[axis]).sum::<f64>()
    };
    for (row, expected) in [("barycentric", [u, v]), ("du", [1.0, 0.0]), ("dv", [0.0, 1.0])] {
        assert!((0..2).all(|axis| (moment(row, axis) - expected[axis]).abs() < 1e-10), "{row}");
    }
}

#[test]
fn mesh_writes_every_format() {
    let folder = tempfile::tempdir().unwrap();
    for (ending, start) in [("obj", &b"v "[..]), ("off", b"OFF"), ("ply", b"ply"), ("stl", b"")] {
        let out = path(&folder.path().join(format!("l.{ending}")));
        let report = casteljau(&["mesh", &model("l.json"), "-o", &out, "--resolution", "8", "--json"])
            .good()
            .json()
            .remove(0);
        assert!(std::fs::read(&out).unwrap().starts_with(start), "{ending}");
        assert_eq!((report["closed"].as_bool(), report["volume"].is_null()), (Some(false), true));
        assert_eq!(report["boundary_edges"], 48);
    }
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 4, "a temporary file was left");
    let obj = casteljau(&["mesh", &model("l.json"), "-o", "-", "--resolution", "8", "--normals"]).good().out;
    let count = |start: &str| obj.lines().filter(|line| line.starts_with(start)).count();
    assert!(count("v ") > 48 && count("v ") == count("vn ") && count("f ") > 48);
}

#[test]
fn a_closed_model_gives_a_closed_mesh() {
    let folder = tempfile::tempdir().unwrap();
    let out = path(&folder.path().join("closed.ply"));
    let report = casteljau(&["mesh", &model("closed.json"), "-o", &out, "--tolerance", "0.05", "--json"])
        .good()
        .json()
        .remove(0);
    assert_eq!((report["closed"].as_bool(), report["boundary_edges"].as_u64()), (Some(true), Some(0)));
    assert!(report["chord_error"].as_f64().unwrap() <= 0.05);
    // Twice the tolerance times the area bounds the difference of two such volumes.
    let coarse = casteljau(&["mesh", &model("closed.json"), "-o", &out, "--tolerance", "0.2", "--json"])
        .good()
        .json()
        .remove(0);
    let (a, b) = (report["volume"].as_f64().unwrap(), coarse["volume"].as_f64().unwrap());
    assert!(a > 1e5 && (a - b).abs() < 2.0 * 0.2 * report["area"].as_f64().unwrap(), "{a} {b}");
    casteljau(&["mesh", &model("closed.json"), "-o", &out]).good();
}

#[test]
fn check_finds_every_promise_kept() {
    for name in MODELS {
        let lines = casteljau(&["check", &model(name), "--json"]).good().json();
        assert!(lines.iter().all(|line| line["ok"] == true), "{name}");
        let joins: Vec<&Value> = lines.iter().filter(|line| line.get("shapes").is_some()).collect();
        match name {
            // Twelve rims and six uprights.
            "closed.json" => assert!(
                joins.len() == 18 && joins.iter().all(|j| j["promised"] == "G0" && j["opposed"] == true)
            ),
            "pair.json" => {
                assert_eq!((joins.len(), joins[0]["promised"].as_str()), (1, Some("G1")));
                assert!(joins[0]["g1"].as_f64().unwrap() < 1e-4);
            }
            _ => assert!(joins.is_empty()),
        }
        casteljau(&["check", &model(name)]).good();
    }
    let pocket = casteljau(&["check", &model("pocket.json"), "--json"]).good().json();
    assert!(pocket.iter().all(|line| line["promised"] == "G2" && line["measured"] == "G2"));
}

#[test]
fn check_finds_a_broken_promise() {
    // A gap that nobody allows.
    casteljau(&["check", &model("u.json"), "--position", "0"]).bad(1, &["u.json", "8 promises are broken"]);
    // The end of the pair bent away: neighbours still share their corners, but no longer the curve between them.
    let text = std::fs::read_to_string(model("pair.json")).unwrap();
    let mut pair: Value = serde_json::from_str(&text).unwrap();
    let z = &mut pair["shapes"][1]["ribbons"][0]["control_points"][0][1][2];
    *z = (z.as_f64().unwrap() + 0.01).into();
    let run = with_input(&["check", "-", "--json"], pair.to_string().as_bytes())
        .bad(1, &["standard input", "1 promise is broken"]);
    let join = run.json().pop().unwrap();
    assert_eq!((join["ok"].as_bool(), join["measured"].as_str()), (Some(false), Some("none")));
    assert!((join["g0"].as_f64().unwrap() - 0.01 * 4.0 / 9.0).abs() < 1e-5, "{join}");
}

#[test]
fn plot_draws_shape_and_domain() {
    let folder = tempfile::tempdir().unwrap();
    let out = path(&folder.path().join("picture.svg"));
    for name in MODELS {
        casteljau(&["plot", &model(name), "-o", &out, "--triangles", "400"]).good();
        let shape = std::fs::read_to_string(&out).unwrap();
        assert!(shape.starts_with("<svg") && shape.ends_with("</svg>\n") && !shape.contains("NaN"));
        casteljau(&["plot", &model(name), "--shape", "0", "--domain", "-o", &out, "--triangles", "400"])
            .good();
        assert!(std::fs::read_to_string(&out).unwrap().contains("Domain polygon"));
    }
    let arguments =
        ["--view", "top", "--shading", "gaussian", "--isolines", "2", "--no-net", "--triangles", "300"];
    let run = casteljau(&[&["plot", &model("l.json"), "-o", "-"], &arguments[..]].concat()).good();
    assert!(run.out.contains("Gaussian curvature"));
    casteljau(&["plot", &model("closed.json"), "--domain", "-o", "-"]).bad(1, &["8 shapes", "--shape"]);
}

#[test]
fn standard_input_is_told_by_its_content() {
    let l = std::fs::read(model("l.json")).unwrap();
    let lines = with_input(&["info", "-", "--json"], &l).good().json();
    assert_eq!(lines[0]["name"], "crowned L");
    with_input(&["info", "-"], b"{\"casteljau\": 1,").bad(1, &["standard input:1:"]);
    // Any ending will do if the content is a model.
    let (_folder, name) = file("model.txt", &l);
    casteljau(&["info", &name]).good();
    // Parameters may come that way, too.
    let (_, [u, v]) = domain_of_l();
    let lines =
        with_input(&["eval", &model("l.json"), "--params", "-", "--json"], format!("{u},{v}").as_bytes())
            .good()
            .json();
    assert_eq!(lines.len(), 1);
    casteljau(&["eval", "-", "--params", "-"]).bad(2, &["cannot both be standard input"]);
}
