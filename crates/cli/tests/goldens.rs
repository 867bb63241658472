//! The exact cases, through the program: written as model files, evaluated, compared.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod support;

use casteljau::geom::{UNIT_ROUNDOFF, rounding_bound};
use serde_json::{Value, json};
use support::{casteljau, file};

/// The cases of one golden file; none where the goldens are absent.
fn cases(name: &str) -> Vec<Value> {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/goldens");
    let Ok(text) = std::fs::read_to_string(folder.join(name)) else {
        println!("the goldens are absent: {name} skipped");
        return Vec::new();
    };
    serde_json::from_str::<Value>(&text).unwrap()["cases"].as_array().unwrap().clone()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| value.as_str().unwrap().parse().unwrap())
}

/// Points of the plane become points of space.
fn in_space(net: &Value) -> Value {
    match net.as_array() {
        Some(rows) if rows.iter().all(Value::is_number) => {
            let mut point = rows.clone();
            point.resize(3, json!(0.0));
            point.into()
        }
        Some(rows) => rows.iter().map(in_space).collect(),
        None => panic!("{net}"),
    }
}

fn model(kind: &str, case: &Value) -> Vec<u8> {
    let mut shape = json!({"kind": kind, "name": case["name"], "degree": case["degree"]});
    if case["homogeneous"].is_array() {
        // Of the plane: (w·x, w·y, w).
        let lifted = |p: &Value| json!([p[0], p[1], 0.0, p[2]]);
        shape["homogeneous"] = case["homogeneous"].as_array().unwrap().iter().map(lifted).collect();
    } else {
        shape["control_points"] = in_space(&case["control_points"]);
        if !case["weights"].is_null() {
            shape["weights"] = case["weights"].clone();
        }
    }
    json!({"casteljau": 1, "shapes": [shape]}).to_string().into_bytes()
}

/// A number, or a list of them.
fn params(sample: &Value, key: &str) -> Vec<Value> {
    match &sample[key] {
        Value::Array(list) => list.clone(),
        single => vec![single.clone()],
    }
}

/// Runs a case and compares value, weight and every derivative up to order 3; the number of samples at poles.
fn check(kind: &str, case: &Value, key: &str) -> usize {
    let samples = case["samples"].as_array().unwrap();
    let (_model_folder, name) = file("case.json", &model(kind, case));
    let lists = samples.iter().map(|sample| {
        let numbers: Vec<String> = params(sample, key).iter().map(ToString::to_string).collect();
        numbers.join(",") + "\n"
    });
    let (_list_folder, list) = file("params", lists.collect::<String>().as_bytes());
    let run = casteljau(&["eval", &name, "--json", "--order", "3", "--params", &list]);
    let lines = run.json();
    assert_eq!(lines.len(), samples.len());
    let degree: usize = match &case["degree"] {
        Value::Array(degrees) => degrees.iter().map(|d| d.as_u64().unwrap() as usize).sum(),
        degree => degree.as_u64().unwrap() as usize,
    };
    let mut poles = 0;
    for (sample, line) in samples.iter().zip(&lines) {
        let what = format!("{} at {}", case["name"], sample[key]);
        if sample["pole"] == true {
            assert!(line["error"].is_string(), "{what}: {line}");
            poles += 1;
            continue;
        }
        // The case with a point at infinity has values alone, of a size below 4.
        let value = json!({"0": sample["value"]});
        let partials = sample["partials"].as_object().or(value.as_object()).unwrap();
        for (orders, exact) in partials {
            let order = orders.split(',').map(|k| k.parse::<usize>().unwrap()).sum::<usize>();
            let scales = match (sample["scale"].get(orders), sample.get("scale0")) {
                (Some(scales), _) => scales.clone(),
                (None, Some(scale)) if order == 0 => scale.clone(),
                (None, None) => json!(4.0),
                _ => continue,
            };
            let got = &line["partials"][orders];
            for (axis, exact) in exact.as_array().unwrap().iter().enumerate() {
                let (got, exact) = (number(&got[axis]), number(exact));
                let scale = scales.get(axis).map_or_else(|| number(&scales), number);
                let allowed =
                    rounding_bound(degree, order, scale) + UNIT_ROUNDOFF * exact.abs() + f64::MIN_POSITIVE;
                assert!(
                    (got - exact).abs() <= allowed,
                    "{what}, {orders}: {got:e} instead of {exact:e}, allowed {allowed:e}"
                );
            }
        }
        if line["weight"].is_number() && case["homogeneous"].is_null() {
            let weights: Vec<f64> = flat(&case["weights"]);
            let scale: f64 = weights.iter().map(|w| w.abs()).fold(0.0, f64::max);
            let inside = params(sample, key).iter().all(|x| (0.0..=1.0).contains(&number(x)));
            let off = (number(&line["weight"]) - number(&sample["weight"])).abs();
            assert!(!inside || off <= rounding_bound(degree, 0, scale), "{what}: weight off by {off:e}");
        }
        if let Some(exact) = sample.get("jacobian_det").filter(|_| line["jacobian"].is_number()) {
            let scale: f64 = ["1,0,0", "0,1,0", "0,0,1"]
                .map(|orders| flat(&sample["scale"][orders]).iter().fold(0.0, |a: f64, b| a.max(*b)))
                .iter()
                .product();
            let off = (number(&line["jacobian"]) - number(exact)).abs();
            assert!(off <= 12.0 * rounding_bound(degree, 1, scale), "{what}: Jacobian off by {off:e}");
        }
        for (field, exact) in [("gaussian", &sample["gaussian"]), ("mean", &sample["mean"])] {
            // Not of nearly singular points, whose curvatures no one can tell from these derivatives.
            if let (Some(got), Some(exact)) = (line[field].as_f64(), exact.as_str()) {
                let exact: f64 = exact.parse().unwrap();
                let principal = sample["principal"]
                    .as_array()
                    .map_or(1.0, |p| p.iter().map(|k| number(k).abs()).fold(0.0, f64::max).max(1e-3));
                let scale = if field == "gaussian" { principal * principal } else { principal };
                let spread =
                    [got, -got].into_iter().map(|got| (got - exact).abs()).fold(f64::INFINITY, f64::min);
                assert!(spread <= 1e-6 * scale.max(1.0), "{what}: {field} {got:e} instead of {exact:e}");
            }
        }
    }
    assert_eq!(run.status, i32::from(poles > 0), "{}", run.err);
    poles
}

/// All numbers of nested lists; none of what is not there.
fn flat(value: &Value) -> Vec<f64> {
    if value.is_null() {
        return Vec::new();
    }
    value.as_array().map_or_else(|| vec![number(value)], |list| list.iter().flat_map(flat).collect())
}

#[test]
fn curves() {
    for case in cases("curves.json") {
        assert_eq!(check("curve", &case, "params"), 0);
    }
}

#[test]
fn rational_curves() {
    for case in cases("rational_curves.json") {
        check("curve", &case, "params");
    }
}

#[test]
fn patches() {
    for case in cases("patches.json").iter().chain(&cases("rational_patches.json")) {
        check("patch", case, "params");
    }
}

#[test]
fn triangles() {
    for case in cases("triangles.json") {
        // Only the values have a scale there; the derivatives are held by the tests of the crate `shape`.
        check("triangle", &case, "lambda_first");
    }
}

#[test]
fn hexahedra_and_tetrahedra() {
    for case in cases("tensor_solids.json") {
        assert_eq!(check("hexahedron", &case, "params"), 0);
    }
    for case in cases("tetrahedra.json") {
        check("tetrahedron", &case, "lambda_first");
    }
}

/// The solids made of patches and curves: point, weight and Jacobian.
#[test]
fn constructions() {
    for case in cases("constructions.json") {
        let inputs = &case["inputs"];
        let degree = |net: &Value| net.as_array().unwrap().len() - 1;
        let curve =
            json!({"degree": degree(&inputs["Q"]), "control_points": inputs["Q"], "weights": inputs["r"]});
        let patch = || {
            let degrees = [degree(&inputs["P"]), degree(&inputs["P"][0])];
            json!({"kind": "patch", "degree": degrees, "control_points": inputs["P"], "weights": inputs["s"]})
        };
        let shape = match case["kind"].as_str().unwrap() {
            "rotational" => json!({"kind": "rotational_solid", "curve": curve}),
            "transitional" => json!({"kind": "transitional_solid", "patch": patch(), "curve": curve}),
            "twisted" => {
                let angle = &inputs["alpha_f64"];
                json!({"kind": "twisted_solid", "patch": patch(), "curve": curve, "angle": angle})
            }
            kind => panic!("{kind}"),
        };
        let model = json!({"casteljau": 1, "shapes": [shape]}).to_string();
        let (_folder, name) = file("case.json", model.as_bytes());
        for sample in case["samples"].as_array().unwrap() {
            let params: Vec<String> = flat(&sample["params"]).iter().map(f64::to_string).collect();
            let run = casteljau(&["eval", &name, "--json", "--order", "1", "--at", &params.join(",")]);
            let line = run.good().json().remove(0);
            let what = format!("{} at {}", case["name"], sample["params"]);
            let near = |got: &Value, exact: &Value, size: f64| {
                for (got, exact) in flat(got).into_iter().zip(flat(exact)) {
                    assert!((got - exact).abs() <= 1e-13 * size, "{what}: {got:e} instead of {exact:e}");
                }
            };
            let size =
                flat(&inputs["Q"]).iter().chain(&flat(&inputs["P"])).fold(1.0, |a: f64, b| a.max(b.abs()));
            near(&line["point"], &sample["point"], 10.0 * size);
            for (orders, field) in [("1,0,0", "du"), ("0,1,0", "dv"), ("0,0,1", "dw")] {
                near(&line["partials"][orders], &sample[field], 100.0 * size);
            }
            near(&line["jacobian"], &sample["jacobian_det"], 1000.0 * size.powi(3));
            if line["weight"].is_number() {
                near(&line["weight"], &sample["weight"], 10.0);
            }
        }
    }
}
