//! What the program answers about solids, against closed forms.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod support;

use std::f64::consts::{FRAC_PI_2, FRAC_PI_6};

use serde_json::{Value, json};
use support::{casteljau, file, model, numbers, path, with_input};

const SOLIDS: [&str; 7] = [
    "ball.json",
    "cone.json",
    "twisted_prism.json",
    "rigid_twist.json",
    "swept_disc.json",
    "quarter_ring.json",
    "ball_octant.json",
];

#[track_caller]
fn near(got: &[f64], exact: &[f64], most: f64) {
    assert_eq!(got.len(), exact.len());
    assert!(got.iter().zip(exact).all(|(a, b)| (a - b).abs() <= most), "{got:?} instead of {exact:?}");
}

fn single(shape: &Value) -> Vec<u8> {
    json!({"casteljau": 1, "shapes": [shape]}).to_string().into_bytes()
}

/// x = u + vw, y = v, z = w over [0, 2] × [0, 1] × [−1, 1]: its Jacobian is 1.
fn sheared() -> Value {
    let point = |u: f64, v: f64, w: f64| [u + v * w, v, w];
    let row = |u, v| [point(u, v, -1.0), point(u, v, 1.0)];
    let slab = |u| [row(u, 0.0), row(u, 1.0)];
    json!({"kind": "hexahedron", "name": "sheared", "degree": [1, 1, 1], "control_points": [slab(0.0), slab(2.0)],
        "intervals": [[0, 2], [0, 1], [-1, 1]]})
}

#[test]
fn eval_has_jacobians_and_partials() {
    let at = ["--at", "1,0.5,-0.25", "--at", "-1,2,3"];
    let run = with_input(&[&["eval", "-", "--json", "--order", "2"][..], &at].concat(), &single(&sheared()));
    let lines = run.good().json();
    near(&numbers(&lines[0]["point"]), &[0.875, 0.5, -0.25], 1e-15);
    near(&numbers(&lines[1]["point"]), &[5.0, 2.0, 3.0], 1e-14);
    assert!(lines[0].get("weight").is_none() && lines[0]["params"] == json!([1.0, 0.5, -0.25]));
    near(&[lines[0]["jacobian"].as_f64().unwrap()], &[1.0], 1e-15);
    let partials = lines[0]["partials"].as_object().unwrap();
    let orders: Vec<&str> = partials.keys().map(String::as_str).collect();
    assert_eq!(orders.len(), 10);
    near(&numbers(&partials["0,1,0"]), &[-0.25, 1.0, 0.0], 1e-15);
    near(&numbers(&partials["0,1,1"]), &[1.0, 0.0, 0.0], 1e-15);
    near(&numbers(&partials["2,0,0"]), &[0.0; 3], 1e-15);
    // The unit ball: inside, half way between its poles, and on the boundary.
    let ball = model("ball.json");
    let lines =
        casteljau(&["eval", &ball, "--json", "--at", "0.5,0.5,0.5", "--at", "0,0.3,0.8"]).good().json();
    let inside = numbers(&lines[0]["point"]);
    assert!(inside[2].abs() < 1e-15 && inside[0].hypot(inside[1]) < 0.5, "{inside:?}");
    assert!(lines[0]["jacobian"].as_f64().unwrap() > 0.0 && lines[0]["weight"].as_f64().unwrap() > 0.0);
    near(&[numbers(&lines[1]["point"]).iter().map(|x| x * x).sum()], &[1.0], 1e-15);
    let text = casteljau(&["eval", &ball, "--at", "0.5,0.5,0.5", "--order", "1"]).good().out;
    assert!(text.contains("Jacobian") && text.contains("weight") && text.contains("partial 0,0,1"), "{text}");
    // A wedge takes (λ1, λ2, w), a tetrahedron (λ1, λ2, λ3).
    let ring = casteljau(&["eval", &model("quarter_ring.json"), "--json", "--at", "0,1,1"]).good().json();
    near(&numbers(&ring[0]["point"]), &[0.0, 2.0, 0.0], 1e-15);
    let octant = casteljau(&["eval", &model("ball_octant.json"), "--json", "--at", "0,0,1"]).good().json();
    near(&numbers(&octant[0]["point"]), &[0.0, 0.0, 1.0], 1e-15);
}

#[test]
fn poles_and_parameters_from_files() {
    let pole =
        json!({"kind": "hexahedron", "degree": [0, 0, 1], "homogeneous": [[[[0, 0, 0, 1], [0, 0, -1, -1]]]]});
    let (_folder, name) = file("pole.json", &single(&pole));
    let (_list_folder, list) = file("list", b"0,0,0.25\n0,0,0.5\n\n0,0,1\n");
    let run = casteljau(&["eval", &name, "--json", "--params", &list]);
    let lines = run.bad(1, &["1 of 3 parameters without an answer"]).json();
    assert_eq!(lines.len(), 3);
    assert!(lines[1]["error"].as_str().unwrap().contains("zero within its uncertainty"));
    assert!(lines[1].get("point").is_none() && lines[2]["point"].is_array());
    for (shape, words) in [
        ("ball.json", "expected three numbers, u,v,w, not 2"),
        ("quarter_ring.json", "expected three numbers, λ1,λ2,w, not 2"),
        ("ball_octant.json", "expected three numbers, λ1,λ2,λ3, not 2"),
    ] {
        casteljau(&["eval", &model(shape), "--at", "0,1"]).bad(2, &[words]);
    }
}

#[test]
fn info_says_what_solids_are_made_of() {
    let info = |name: &str| casteljau(&["info", &model(name), "--json"]).good().json().remove(0);
    let ball = info("ball.json");
    assert_eq!((&ball["kind"], &ball["degree"]), (&json!("rotational_solid"), &json!([2, 2, 3])));
    assert_eq!((&ball["rational"], &ball["control_points"]), (&json!(true), &json!(36)));
    assert_eq!(ball["construction"], json!({"curve": 3}));
    near(&numbers(&ball["bounds"]["min"]), &[-1.0; 3], 1e-4);
    near(&numbers(&ball["bounds"]["max"]), &[1.0; 3], 1e-4);
    let twisted = info("twisted_prism.json");
    assert_eq!(twisted["construction"], json!({"patch": [1, 1], "curve": 3, "angle": FRAC_PI_6}));
    assert_eq!((&twisted["rational"], &twisted["degree"]), (&json!(false), &json!([1, 1, 3])));
    let rigid = info("rigid_twist.json");
    assert_eq!(rigid["construction"], json!({"patch": [1, 1], "curve": 1, "rigid_angle": FRAC_PI_2}));
    let ring = info("quarter_ring.json");
    assert_eq!((&ring["degree"], &ring["interval"]), (&json!([1, 2]), &json!([0.0, 1.0])));
    assert_eq!(info("ball_octant.json")["degree"], json!(4));
    for name in SOLIDS {
        let text = casteljau(&["info", &model(name)]).good().out;
        assert!(text.contains("bounds") && text.contains("degree"), "{text}");
    }
    assert!(casteljau(&["info", &model("ball.json")]).good().out.contains("rotated about the z axis"));
}

#[test]
fn convert_there_and_back() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| path(&folder.path().join(name));
    for name in SOLIDS {
        let (vtu, json, again) = (at("a.vtu"), at("b.json"), at("c.vtu"));
        casteljau(&["convert", &model(name), &vtu]).good();
        casteljau(&["convert", &vtu, &json]).good();
        casteljau(&["convert", &json, &again]).good();
        assert_eq!(std::fs::read(&vtu).unwrap(), std::fs::read(&again).unwrap(), "{name}");
        // By what it begins with, from standard input.
        let piped = with_input(&["convert", "-", "-", "--format", "vtu"], &std::fs::read(&vtu).unwrap());
        assert_eq!(piped.good().out.into_bytes(), std::fs::read(&vtu).unwrap());
        let place = ["--at", "0.25,0.3,0.125", "--json"];
        let point = |file: &str| {
            numbers(&casteljau(&[&["eval", file][..], &place].concat()).good().json()[0]["point"])
        };
        near(&point(&model(name)), &point(&vtu), 1e-14);
        // Raising degrees changes no point.
        casteljau(&["convert", &model(name), &at("d.json"), "--elevate", "2"]).good();
        near(&point(&model(name)), &point(&at("d.json")), 1e-13);
        casteljau(&["convert", &model(name), &at("no.json"), "--to", "power"])
            .bad(1, &["a solid has no power basis"]);
    }
    casteljau(&["convert", &model("torus.json"), &at("t.vtu")]).good();
    assert_eq!(casteljau(&["info", &at("t.vtu"), "--json"]).good().json().len(), 16);
}

#[test]
fn domains_are_those_of_gb_patches() {
    casteljau(&["domain", &model("ball.json")])
        .bad(1, &["ball.json:5: ", "kind `rotational_solid` is no GB patch"]);
}

#[test]
fn plots_show_faces_and_nets() {
    let folder = tempfile::tempdir().unwrap();
    let out = path(&folder.path().join("solid.svg"));
    for name in SOLIDS {
        casteljau(&["plot", &model(name), "-o", &out]).good();
        let svg = std::fs::read_to_string(&out).unwrap();
        assert!(svg.starts_with("<svg") && svg.contains("<circle"), "{name}");
        casteljau(&["plot", &model(name), "-o", &out, "--no-net", "--isolines", "none"]).good();
        assert!(!std::fs::read_to_string(&out).unwrap().contains("<circle"));
    }
    casteljau(&["plot", &model("ball.json"), "-o", &out, "--construction", "0.5,0.5"])
        .bad(2, &["--construction"]);
}

/// Every sample is valid; volumes are those of the closed forms where there is one.
#[test]
fn check_certifies_and_measures() {
    use std::f64::consts::PI;
    let volumes = [4.0 / 3.0 * PI, 2.0 / 3.0 * PI, f64::NAN, f64::NAN, PI * 3_f64.sqrt(), f64::NAN, PI / 6.0];
    for (name, exact) in SOLIDS.into_iter().zip(volumes) {
        let lines = casteljau(&["check", &model(name), "--json"]).good().json();
        let [line] = &lines[..] else { panic!("{name}: {lines:?}") };
        let verdict = line["verdict"].as_str().unwrap();
        assert!(["positive", "positive-except"].contains(&verdict) && line["ok"] == true, "{name}: {line}");
        assert_eq!(verdict == "positive", line.get("except").is_none(), "{name}");
        let volume = line["volume"].as_f64().unwrap();
        assert!(exact.is_nan() || (volume - exact).abs() <= 1e-11 * exact, "{name}: {volume} {exact}");
        let info = casteljau(&["info", &model(name), "--json"]).good().json();
        assert_eq!(info[0]["volume"], line["volume"]);
    }
    let ball = casteljau(&["check", &model("ball.json"), "--json"]).good().json();
    let except: Vec<&str> =
        ball[0]["except"].as_array().unwrap().iter().map(|e| e.as_str().unwrap()).collect();
    assert_eq!(
        except,
        [
            "face w = 0",
            "face w = 1",
            "edge u = 0, v = 0",
            "edge u = 0, v = 1",
            "edge u = 1, v = 0",
            "edge u = 1, v = 1"
        ]
    );
    let text = casteljau(&["check", &model("ball.json")]).good();
    assert!(
        text.out.contains("positive but on face w = 0") && text.out.contains("volume 4.18879"),
        "{}",
        text.out
    );
}

/// A solid turned inside out, and a folded one, are told with a witness in their own parameters; the exit status is 1.
#[test]
fn check_refuses_turned_and_folded_solids() {
    let mut turned = sheared();
    turned["intervals"] = json!([[0, 2], [0, 4], [-1, 1]]);
    let slabs = turned["control_points"].as_array().unwrap().clone();
    turned["control_points"] = json!([slabs[1], slabs[0]]);
    let run = with_input(&["check", "-", "--json"], &single(&turned));
    assert_eq!(run.status, 1);
    let line = &run.json()[0];
    assert_eq!((&line["verdict"], &line["ok"]), (&json!("invalid"), &json!(false)));
    near(&[line["jacobian"].as_f64().unwrap()], &[-0.25], 1e-15);
    near(&[line["volume"].as_f64().unwrap()], &[-4.0], 1e-14);
    let witness = numbers(&line["witness"]);
    assert!(
        (0.0..=2.0).contains(&witness[0]) && (0.0..=4.0).contains(&witness[1]) && witness[2].abs() <= 1.0
    );

    let mut folded = sheared();
    folded["control_points"][1][1][1] = json!([-5.0, -5.0, -5.0]);
    let run = with_input(&["check", "-", "--json"], &single(&folded));
    assert_eq!(run.status, 1);
    let witness = &run.json()[0]["witness"];
    let at = numbers(witness).iter().map(f64::to_string).collect::<Vec<_>>().join(",");
    let there = with_input(&["eval", "-", "--json", "--at", &at], &single(&folded)).good().json();
    assert!(there[0]["jacobian"].as_f64().unwrap() < 0.0, "{there:?}");
    let text = with_input(&["check", "-"], &single(&folded));
    assert!(text.out.contains("INVALID"), "{}", text.out);
}
