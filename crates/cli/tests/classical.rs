//! What the program answers about curves, patches and triangles, against closed forms.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod support;

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use serde_json::{Value, json};
use support::{casteljau, file, model, numbers, path, with_input};

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

#[track_caller]
fn near(got: &[f64], exact: &[f64], most: f64) {
    assert_eq!(got.len(), exact.len());
    assert!(got.iter().zip(exact).all(|(a, b)| (a - b).abs() <= most), "{got:?} instead of {exact:?}");
}

/// A model of one shape.
fn single(shape: &Value) -> Vec<u8> {
    json!({"casteljau": 1, "shapes": [shape]}).to_string().into_bytes()
}

#[test]
fn the_patch_of_the_literature() {
    let patch = model("parabolic_cylinder.json");
    let line =
        casteljau(&["eval", &patch, "--json", "--order", "3", "--at", "0.5,0.5"]).good().json().remove(0);
    near(&numbers(&line["point"]), &[1.5, 1.0, 0.75], 0.0);
    near(&numbers(&line["normal"]), &[0.0, 0.0, -1.0], 1e-15);
    near(&[number(&line["gaussian"]), number(&line["mean"])], &[0.0, 1.0 / 3.0], 1e-15);
    near(&numbers(&line["principal"]), &[0.0, 2.0 / 3.0], 1e-15);
    assert!(line.get("weight").is_none());
    let partials = line["partials"].as_object().unwrap();
    assert_eq!(partials.len(), 10);
    for (key, exact) in [
        ("0,0", [1.5, 1.0, 0.75]),
        ("1,0", [0.0, 2.0, 0.0]),
        ("0,1", [3.0, 0.0, 0.0]),
        ("0,2", [0.0, 0.0, -6.0]),
        ("3,0", [0.0; 3]),
    ] {
        near(&numbers(&partials[key]), &exact, 1e-14);
    }
    // Outside the square the polynomial goes on: r(u, v) = (3v, 2u, 3v(1 − v)).
    let outside = casteljau(&["eval", &patch, "--json", "--at", "-1,2"]).good().json().remove(0);
    near(&numbers(&outside["point"]), &[6.0, -2.0, -6.0], 1e-13);
}

#[test]
fn info_measures_lengths_areas_and_boxes() {
    let info = |name: &str| casteljau(&["info", &model(name), "--json"]).good().json();
    let circle = &info("circle.json")[0];
    assert_eq!(
        (&circle["kind"], &circle["degree"], &circle["rational"]),
        (&json!("curve"), &json!(5), &json!(true))
    );
    assert_eq!(circle["interval"], json!([0.0, TAU]));
    near(&[number(&circle["length"])], &[TAU], 1e-8);
    assert!(number(&circle["length_error"]) <= 1e-8);
    near(&numbers(&circle["bounds"]["min"]), &[-1.0, -1.0, 0.0], 2e-5);
    near(&numbers(&circle["bounds"]["max"]), &[1.0, 1.0, 0.0], 2e-5);
    let cylinder = &info("parabolic_cylinder.json")[0];
    assert_eq!((&cylinder["degree"], &cylinder["rational"]), (&json!([2, 3]), &json!(false)));
    assert_eq!(cylinder["intervals"], json!([[0.0, 1.0], [0.0, 1.0]]));
    // Twice the length of the parabola z = y(3 − y)/3 over [0, 3].
    let parabola = 1.5 * (2_f64.sqrt() + 1_f64.asinh());
    near(&[number(&cylinder["area"])], &[2.0 * parabola], 1e-7);
    near(&[numbers(&cylinder["bounds"]["max"])[2]], &[0.75], 1e-5);
    let octant = &info("octant.json")[0];
    assert_eq!((&octant["kind"], &octant["degree"]), (&json!("triangle"), &json!(4)));
    near(&[number(&octant["area"])], &[FRAC_PI_2], 1e-8);
    let sum = |name: &str| info(name).iter().map(|line| number(&line["area"])).sum::<f64>();
    near(&[sum("sphere.json"), sum("torus.json")], &[4.0 * PI, 12.0 * PI * PI], 1e-6);
    let cubic = &info("twisted_cubic.json")[0];
    assert_eq!((&cubic["kind"], &cubic["control_points"]), (&json!("power_curve"), &json!(4)));
    near(&numbers(&cubic["bounds"]["max"]), &[2.0, 4.0, 8.0], 1e-4);
    for name in ["circle.json", "roof.json", "octant.json", "twisted_cubic.json"] {
        assert!(casteljau(&["info", &model(name)]).good().out.contains("bounds"));
    }
}

#[test]
fn eval_of_curves_has_frames() {
    let line = casteljau(&["eval", &model("twisted_cubic.json"), "--json", "--at", "0", "--order", "4"])
        .good()
        .json()
        .remove(0);
    near(&numbers(&line["tangent"]), &[1.0, 0.0, 0.0], 0.0);
    near(&[number(&line["curvature"]), number(&line["torsion"])], &[2.0, 3.0], 1e-15);
    assert_eq!(line["params"], json!([0.0]));
    assert_eq!(
        line["partials"],
        json!({"0": [0.0, 0.0, 0.0], "1": [1.0, 0.0, 0.0], "2": [0.0, 2.0, 0.0], "3": [0.0, 0.0, 6.0], "4": [0.0, 0.0, 0.0]})
    );
    let circle =
        casteljau(&["eval", &model("circle.json"), "--json", "--at", "1", "--at", "6.2"]).good().json();
    for line in circle {
        near(&[number(&line["curvature"]), number(&line["torsion"])], &[1.0, 0.0], 1e-13);
        assert!(number(&line["weight"]) > 0.0);
    }
    // A straight line has no osculating plane, a point no tangent.
    let straight = json!({"kind": "curve", "degree": 1, "control_points": [[0, 0, 0], [3, 4, 0]]});
    let line =
        with_input(&["eval", "-", "--json", "--at", "0.5"], &single(&straight)).good().json().remove(0);
    near(&numbers(&line["tangent"]), &[0.6, 0.8, 0.0], 1e-15);
    assert_eq!((&line["curvature"], &line["torsion"]), (&json!(0.0), &Value::Null));
    let point = json!({"kind": "curve", "degree": 0, "control_points": [[1, 2, 3]]});
    let line = with_input(&["eval", "-", "--json", "--at", "7"], &single(&point)).good().json().remove(0);
    assert_eq!(
        (&line["point"], &line["tangent"], &line["curvature"]),
        (&json!([1.0, 2.0, 3.0]), &Value::Null, &Value::Null)
    );
    assert!(
        casteljau(&["eval", &model("circle.json"), "--at", "1", "--order", "1"])
            .good()
            .out
            .contains("torsion")
    );
}

#[test]
fn triangles_take_two_barycentric_coordinates() {
    let octant = model("octant.json");
    let lines = casteljau(&["eval", &octant, "--json", "--at", "1,0", "--at", "0.2,0.3"]).good().json();
    near(&numbers(&lines[0]["point"]), &[1.0, 0.0, 0.0], 1e-15);
    let (point, normal) = (numbers(&lines[1]["point"]), numbers(&lines[1]["normal"]));
    near(&point, &normal, 1e-13);
    near(&[number(&lines[1]["gaussian"]), number(&lines[1]["mean"])], &[1.0, -1.0], 1e-12);
    // The pole of a sphere's patch: a normal, by its limit, and no curvature.
    let sphere = model("sphere.json");
    let line =
        casteljau(&["eval", &sphere, "--shape", "0", "--json", "--at", "0.3,1"]).good().json().remove(0);
    near(&numbers(&line["point"]), &[0.0, 0.0, 1.0], 1e-15);
    near(&numbers(&line["normal"]), &[0.0, 0.0, 1.0], 1e-12);
    assert!(line["gaussian"].is_null() && line["principal"].is_null());
}

#[test]
fn a_pole_has_an_error_and_the_rest_is_answered() {
    let pole = json!({"kind": "curve", "degree": 1, "homogeneous": [[0, 0, 0, 1], [-1, 0, 0, -1]]});
    let (_folder, name) = file("pole.json", &single(&pole));
    let run = casteljau(&["eval", &name, "--json", "--at", "0.25", "--at", "0.5", "--at", "1"]);
    let run = run.bad(1, &["1 of 3 parameters without an answer"]);
    let lines = run.json();
    assert_eq!(lines.len(), 3);
    assert_eq!(lines[1]["params"], json!([0.5]));
    assert!(lines[1]["error"].as_str().unwrap().contains("zero within its uncertainty"));
    assert!(lines[1].get("point").is_none() && lines[0]["point"].is_array() && lines[2]["point"].is_array());
    assert_eq!(lines[0]["weight"], json!(0.5));
    let line = casteljau(&["info", &name, "--json"]).good().json().remove(0);
    assert!(line["bounds"].is_null() && line["length"].is_null());
}

#[test]
fn what_overflows_is_null_and_the_point_is_answered() {
    // Over an interval of 1e-200 first derivatives are 1e200, second ones nothing that a number holds.
    let arc = json!({"kind": "curve", "degree": 2, "control_points": [[0, 0, 0], [1, 0, 0], [1, 1, 0]],
        "interval": [0.0, 1e-200]});
    let answer = |shape: &Value, arguments: &[&str]| {
        let all = [&["eval", "-", "--json"], arguments].concat();
        with_input(&all, &single(shape)).good().json().remove(0)
    };
    let line = answer(&arc, &["--at", "0", "--order", "3"]);
    assert_eq!(line["point"], json!([0.0, 0.0, 0.0]));
    near(&numbers(&line["tangent"]), &[1.0, 0.0, 0.0], 1e-15);
    assert!(line["curvature"].is_null() && line["torsion"].is_null());
    near(&numbers(&line["partials"]["1"]), &[2e200, 0.0, 0.0], 1e185);
    assert_eq!((line["partials"].as_object().unwrap().len(), &line["partials"]["2"]), (4, &Value::Null));
    assert_eq!(line["partials"]["3"], json!([0.0, 0.0, 0.0]));
    let line = answer(&arc, &["--at", "0"]);
    assert!(line["point"].is_array() && line.get("partials").is_none());

    // z = u² + v² over [0, 1e-200] × [0, 1]: of the second derivatives only that with u is beyond the range.
    let net: Vec<Vec<[f64; 3]>> = (0..3)
        .map(|i| {
            (0..3)
                .map(|j| {
                    [
                        i as f64 / 2.0,
                        j as f64 / 2.0,
                        f64::from(u8::from(i == 2)) + f64::from(u8::from(j == 2)),
                    ]
                })
                .collect()
        })
        .collect();
    let bowl = json!({"kind": "patch", "degree": [2, 2], "control_points": net, "intervals": [[0.0, 1e-200], [0.0, 1.0]]});
    let line = answer(&bowl, &["--at", "0,0", "--order", "2"]);
    assert_eq!(line["point"], json!([0.0, 0.0, 0.0]));
    near(&numbers(&line["normal"]), &[0.0, 0.0, 1.0], 1e-15);
    assert!(line["gaussian"].is_null() && line["mean"].is_null() && line["principal"].is_null());
    assert!(line["partials"]["2,0"].is_null());
    near(&numbers(&line["partials"]["1,0"]), &[1e200, 0.0, 0.0], 1e185);
    near(&numbers(&line["partials"]["0,2"]), &[0.0, 0.0, 2.0], 1e-14);
    let text = with_input(&["eval", "-", "--at", "0,0", "--order", "2"], &single(&bowl)).good().out;
    assert!(
        text.contains("partial 2,0  none") && text.contains("Gaussian none, mean none, principal none"),
        "{text}"
    );

    // So close to a pole that the point is finite and no derivative is; the pole itself has no answer.
    let near_pole = json!({"kind": "curve", "degree": 1, "homogeneous": [[1, 0, 0, 1e-200], [1, 0, 0, -1]]});
    let line = answer(&near_pole, &["--at", "0", "--order", "1"]);
    near(&numbers(&line["point"]), &[1e200, 0.0, 0.0], 1e185);
    assert!(line["tangent"].is_null() && line["partials"]["1"].is_null());
    let beyond = json!({"kind": "curve", "degree": 1, "homogeneous": [[1e120, 0, 0, 1e-200], [1, 0, 0, -1]]});
    for (shape, word) in [
        (&beyond, "leave"),
        (&json!({"kind": "curve", "degree": 1, "homogeneous": [[1, 0, 0, 0], [1, 0, 0, -1]]}), "zero within"),
    ] {
        let run = with_input(&["eval", "-", "--json", "--at", "0"], &single(shape)).bad(1, &["1 of 1"]);
        let line = run.json().remove(0);
        assert!(line.get("point").is_none() && line["error"].as_str().unwrap().contains(word), "{line}");
    }
}

#[test]
fn parameters_must_fit_the_shape() {
    let (circle, octant) = (model("circle.json"), model("octant.json"));
    casteljau(&["eval", &circle, "--at", "0,0"]).bad(2, &["--at 0,0: expected one number, t, not 2"]);
    casteljau(&["eval", &octant, "--at", "0.1,0.2,0.7"]).bad(2, &["expected two numbers, λ1,λ2, not 3"]);
    assert_eq!(casteljau(&["eval", &octant, "--at", "0,0", "--order", "51"]).status, 2);
    let (_folder, list) = file("list", b"0.5\n\n1,2\n");
    casteljau(&["eval", &circle, "--params", &list]).bad(1, &[":3: `1,2`: expected one number"]);
    // A curve and a patch in one file: each parameter is answered by the shape it fits.
    let two = json!({"casteljau": 1, "shapes": [
        {"kind": "curve", "degree": 0, "control_points": [[1, 2, 3]]},
        {"kind": "power_patch", "coefficients": [[[1, 2, 3]]]}]});
    let run = with_input(&["eval", "-", "--json", "--at", "0", "--at", "0,1"], two.to_string().as_bytes());
    let lines = run.bad(1, &["2 of 4 parameters"]).json();
    let errors: Vec<bool> = lines.iter().map(|line| line.get("error").is_some()).collect();
    assert_eq!(errors, [false, true, true, false]);
    casteljau(&["domain", &circle]).bad(1, &["circle.json:", "a shape of kind `curve` is no GB patch"]);
}

#[test]
fn check_tells_how_shapes_meet() {
    let pair = casteljau(&["check", &model("curvature_pair.json"), "--json"]).good().json();
    assert_eq!(pair.len(), 1);
    let line = &pair[0];
    assert_eq!(
        (&line["shapes"], &line["sides"], &line["opposed"]),
        (&json!([0, 1]), &json!([1, 0]), &json!(true))
    );
    assert_eq!(
        (&line["measured"], &line["parametric"], &line["promised"]),
        (&json!("G2"), &json!("C1"), &Value::Null)
    );
    assert!(
        number(&line["g0"]) == 0.0
            && number(&line["g1"]) < 1e-6
            && number(&line["g2"]) < 1e-12
            && number(&line["c2"]) > 1e-3
    );
    // Once around: the end meets the start.
    let circle = casteljau(&["check", &model("circle.json"), "--json"]).good().json();
    assert_eq!(
        (circle.len(), &circle[0]["sides"], &circle[0]["measured"]),
        (1, &json!([0, 1]), &json!("G2"))
    );
    // 16 patches in rings both ways, each edge shared once.
    let torus = casteljau(&["check", &model("torus.json"), "--json"]).good().json();
    assert_eq!(torus.len(), 32);
    for line in &torus {
        assert_eq!((&line["measured"], &line["opposed"]), (&json!("G2"), &json!(true)), "{line}");
    }
    // Eight octants: twelve quarters of circles, none at the poles.
    let sphere = casteljau(&["check", &model("sphere.json"), "--json"]).good().json();
    assert_eq!(sphere.len(), 12);
    assert!(sphere.iter().all(|line| line["measured"] == "G2"), "{sphere:?}");
    assert!(casteljau(&["check", &model("roof.json")]).good().out.contains("no two"));
    assert!(casteljau(&["check", &model("torus.json")]).good().out.contains("G2"));
    // Two squares with a crease of a right angle between them, edges run the same way.
    let crease = json!({"casteljau": 1, "shapes": [
        {"kind": "patch", "degree": [1, 1], "control_points": [[[0, 0, 0], [0, 1, 0]], [[1, 0, 0], [1, 1, 0]]]},
        {"kind": "triangle", "degree": 1, "control_points": [[0, 0, 0], [0, 1, 0], [0, 0, 1]]}]});
    let lines = with_input(&["check", "-", "--json"], crease.to_string().as_bytes()).good().json();
    assert_eq!((lines.len(), &lines[0]["measured"]), (1, &json!("G0")));
    near(&[number(&lines[0]["g1"])], &[90.0], 1e-12);
}

/// The bicubic net of z = x²/5 − xy/10 + y²/10 over [a, a+1] × [0, 1], i with x, j with y.
fn bicubic(a: f64) -> Vec<Vec<[f64; 3]>> {
    let arguments = |from: f64, i: usize| [0, 1, 2].map(|k| if k < i { from + 1.0 } else { from });
    let mean = |x: [f64; 3]| (x[0] + x[1] + x[2]) / 3.0;
    let square = |x: [f64; 3]| (x[0] * x[1] + x[1] * x[2] + x[2] * x[0]) / 3.0;
    let point = |i: usize, j: usize| {
        let (x, y) = (arguments(a, i), arguments(0.0, j));
        [mean(x), mean(y), square(x) / 5.0 - mean(x) * mean(y) / 10.0 + square(y) / 10.0]
    };
    (0..4).map(|i| (0..4).map(|j| point(i, j)).collect()).collect()
}

#[test]
fn check_compares_gb_sides_with_other_surfaces() {
    let net = bicubic(1.0);
    let row = |at: &dyn Fn(usize) -> [f64; 3]| (0..4).map(at).collect::<Vec<_>>();
    let sides = [
        [row(&|k| net[k][0]), row(&|k| net[k][1])],
        [row(&|k| net[3][k]), row(&|k| net[2][k])],
        [row(&|k| net[3 - k][3]), row(&|k| net[3 - k][2])],
        [row(&|k| net[0][3 - k]), row(&|k| net[1][3 - k])],
    ];
    let ribbons: Vec<Value> = sides.iter().map(|rows| json!({"control_points": rows})).collect();
    let gb = json!({"kind": "gb_patch", "layout": "regular", "ribbons": ribbons});
    let run = |neighbour: &[Vec<[f64; 3]>]| {
        let patch = json!({"kind": "patch", "degree": [3, 3], "control_points": neighbour});
        let model = json!({"casteljau": 1, "shapes": [patch, gb]}).to_string();
        let lines = with_input(&["check", "-", "--json"], model.as_bytes()).good().json();
        let joins: Vec<Value> = lines.into_iter().filter(|line| line.get("shapes").is_some()).collect();
        assert_eq!(joins.len(), 1);
        joins[0].clone()
    };
    let smooth = run(&bicubic(0.0));
    // The patch's edge at the end of u meets the last side.
    assert_eq!((&smooth["shapes"], &smooth["sides"]), (&json!([1, 0]), &json!([3, 1])));
    assert_eq!((&smooth["opposed"], &smooth["promised"]), (&json!(true), &json!("G1")));
    assert!(number(&smooth["g0"]) < 1e-14 && number(&smooth["g1"]) < 1e-6, "{smooth}");
    let mut creased = bicubic(0.0);
    creased[2].iter_mut().for_each(|point| point[2] += 0.1);
    let crease = run(&creased);
    assert_eq!((&crease["promised"], &crease["measured"]), (&json!("G0"), &json!("G0")));
    // The edge keeps its tangents, the cross derivative (1, 0, z) loses 0.3 of its slope.
    assert!(number(&crease["g1"]) > 10.0);
}

#[test]
fn convert_changes_basis_degree_and_format() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| path(&folder.path().join(name));
    // Normalising is idempotent, for every sample.
    for name in ["roof.json", "torus.json", "octant.json", "twisted_cubic.json", "l.json"] {
        casteljau(&["convert", &model(name), &at(name)]).good();
        assert_eq!(std::fs::read(at(name)).unwrap(), std::fs::read(model(name)).unwrap(), "{name}");
    }
    casteljau(&[
        "convert",
        &model("twisted_cubic.json"),
        &at("bezier.json"),
        "--to",
        "bezier",
        "--elevate",
        "2",
    ])
    .good();
    let curve =
        &serde_json::from_slice::<Value>(&std::fs::read(at("bezier.json")).unwrap()).unwrap()["shapes"][0];
    assert_eq!(
        (&curve["kind"], &curve["degree"], &curve["interval"]),
        (&json!("curve"), &json!(5), &json!([-1.0, 2.0]))
    );
    casteljau(&["convert", &at("bezier.json"), &at("power.json"), "--to", "power"]).good();
    for name in ["bezier.json", "power.json"] {
        let line = casteljau(&["eval", &at(name), "--json", "--at", "1.5"]).good().json().remove(0);
        near(&numbers(&line["point"]), &[1.5, 2.25, 3.375], 1e-13);
    }
    casteljau(&["convert", &model("torus.json"), &at("torus.vtu")]).good();
    let vtu = std::fs::read_to_string(at("torus.vtu")).unwrap();
    assert!(vtu.contains("NumberOfPoints=\"144\" NumberOfCells=\"16\"") && vtu.contains("version=\"2.2\""));
    let streamed = casteljau(&["convert", &model("torus.json"), "-", "--format", "vtu"]).good();
    assert_eq!(streamed.out, vtu);
    casteljau(&["convert", &model("l.json"), &at("l.cgb")]).good();
    assert_eq!(casteljau(&["info", &at("l.cgb"), "--json"]).good().json().len(), 1);
    // What cannot be, and leaves nothing behind.
    casteljau(&["convert", &model("circle.json"), &at("no.json"), "--to", "power"])
        .bad(1, &["circle.json:4: shapes[0]: a rational curve has no power basis"]);
    casteljau(&["convert", &model("l.json"), &at("no.vtu")]).bad(1, &["l.json:", "GB patches"]);
    casteljau(&["convert", &model("roof.json"), &at("no.cgb")]).bad(1, &["no.cgb: ", "kind `patch`"]);
    casteljau(&["convert", &model("roof.json"), &at("no.step")]).bad(1, &["known endings: json, cgb, vtu"]);
    casteljau(&["convert", &model("circle.json"), &at("no.json"), "--elevate", "1000"])
        .bad(1, &["circle.json:4: shapes[0]: ", "1005"]);
    assert_eq!(
        std::fs::read_dir(folder.path())
            .unwrap()
            .filter(|entry| { entry.as_ref().unwrap().file_name().to_string_lossy().starts_with("no.") })
            .count(),
        0
    );
}

#[test]
fn surfaces_are_meshed() {
    let folder = tempfile::tempdir().unwrap();
    let out = path(&folder.path().join("torus.obj"));
    let line = casteljau(&["mesh", &model("torus.json"), "-o", &out, "--resolution", "16", "--json"])
        .good()
        .json()
        .remove(0);
    assert_eq!((&line["closed"], &line["shapes"]), (&json!(true), &json!(16)));
    // 2π² R r², less what inscribed faces miss.
    near(&[number(&line["volume"])], &[6.0 * PI * PI], 0.015 * 6.0 * PI * PI);
}

#[test]
fn curves_become_polylines() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| path(&folder.path().join(name));
    let circle = model("circle.json");
    let mesh = |out: &str| casteljau(&["mesh", &circle, "-o", &at(out), "--resolution", "100", "--json"]);
    let line = mesh("c.obj").good().json().remove(0);
    assert_eq!((&line["vertices"], &line["edges"]), (&json!(101), &json!(100)));
    near(&[number(&line["length"])], &[TAU], 0.01);
    let text = std::fs::read_to_string(at("c.obj")).unwrap();
    assert_eq!(text.lines().filter(|line| line.starts_with("v ")).count(), 101);
    assert!(text.lines().last().unwrap().starts_with("l 1 2 3 "));
    mesh("c.ply").good();
    let bytes = std::fs::read(at("c.ply")).unwrap();
    let end = b"end_header\n";
    let start = bytes.windows(end.len()).position(|window| window == end).unwrap() + end.len();
    assert_eq!(bytes.len() - start, 101 * 24 + 100 * 8);
    mesh("c.stl").bad(1, &["c.stl: curves have no triangles"]);
    let huge = usize::MAX.to_string();
    casteljau(&["mesh", &circle, "-o", &at("c.obj"), "--resolution", &huge])
        .bad(1, &["circle.json", "needs more than", "edges"]);
}

#[test]
fn polylines_keep_a_tolerance() {
    let folder = tempfile::tempdir().unwrap();
    let out = path(&folder.path().join("c.obj"));
    let circle = model("circle.json");
    let line =
        casteljau(&["mesh", &circle, "-o", &out, "--tolerance", "1e-4", "--json"]).good().json().remove(0);
    let bound = number(&line["chord_error"]);
    assert!(bound <= 1e-4);
    // The unit circle leaves a chord between angles 2φ apart by 1 − cos φ.
    let text = std::fs::read_to_string(&out).unwrap();
    let points: Vec<[f64; 2]> = text
        .lines()
        .filter_map(|line| line.strip_prefix("v "))
        .map(|line| {
            let mut numbers = line.split(' ').map(|word| word.parse().unwrap());
            [numbers.next().unwrap(), numbers.next().unwrap()]
        })
        .collect();
    assert_eq!(json!(points.len()), line["vertices"]);
    let sagitta = |[[a, b], [c, d]]: [[f64; 2]; 2]| 1.0 - (0.5 * (a + c)).hypot(0.5 * (b + d));
    let worst = points.windows(2).map(|ends| sagitta([ends[0], ends[1]])).fold(0.0, f64::max);
    assert!(worst <= bound && worst >= 0.2e-4, "{worst:e} of {bound:e}");
    // Without either option a tolerance is chosen by the size.
    let line = casteljau(&["mesh", &circle, "-o", &out, "--json"]).good().json().remove(0);
    assert!(number(&line["chord_error"]) <= number(&line["tolerance"]));
}

#[test]
fn shapes_are_drawn() {
    let folder = tempfile::tempdir().unwrap();
    let out = path(&folder.path().join("p.svg"));
    let drawn = |name: &str, options: &[&str]| {
        casteljau(&[&["plot", &model(name), "-o", &out], options].concat()).good();
        std::fs::read_to_string(&out).unwrap()
    };
    let plain = drawn("plane_curve.json", &[]);
    for options in [&["--comb"][..], &["--frames", "5"], &["--construction", "0.4"], &["--view", "iso"]] {
        assert_ne!(drawn("plane_curve.json", options), plain, "{options:?}");
    }
    drawn("curvature_pair.json", &["--comb", "--no-net"]);
    let plain = drawn("parabolic_cylinder.json", &[]);
    for options in [&["--shading", "mean"][..], &["--no-net"], &["--construction", "0.5,0.25"]] {
        assert_ne!(drawn("parabolic_cylinder.json", options), plain, "{options:?}");
    }
    drawn("torus.json", &["--shading", "gaussian"]);
    drawn("octant.json", &["--construction", "0.2,0.3"]);

    let refused = |name: &str, options: &[&str], words: &[&str]| {
        casteljau(&[&["plot", &model(name), "-o", &out], options].concat()).bad(2, words);
    };
    refused("l.json", &["--comb"], &["--comb", "curves"]);
    refused("l.json", &["--construction", "0,0"], &["--construction"]);
    refused("octant.json", &["--frames", "3"], &["--frames", "curves"]);
    refused("octant.json", &["--construction", "0.5"], &["--construction 0.5", "λ1,λ2"]);
    refused("plane_curve.json", &["--construction", "1,2"], &["--construction 1,2", "one number"]);
    refused("parabolic_cylinder.json", &["--isolines", "distances"], &["--isolines"]);
    casteljau(&["plot", &model("circle.json"), "-o", &out, "--domain"]).bad(1, &["circle.json"]);
}

#[test]
fn families_are_not_mixed_in_one_picture() {
    let folder = tempfile::tempdir().unwrap();
    let out = path(&folder.path().join("p.svg"));
    let both = json!({"casteljau": 1, "shapes": [
        {"kind": "curve", "degree": 1, "control_points": [[0, 0, 0], [1, 0, 0]]},
        {"kind": "triangle", "degree": 1, "control_points": [[0, 0, 0], [1, 0, 0], [0, 1, 0]]}
    ]});
    let (_keep, both) = file("both.json", both.to_string().as_bytes());
    casteljau(&["plot", &both, "-o", &out]).bad(1, &["both.json", "--shape"]);
    casteljau(&["plot", &both, "-o", &out, "--shape", "1"]).good();
}
