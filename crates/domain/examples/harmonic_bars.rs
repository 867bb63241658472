//! The figures of harmonic coordinates on the golden polygons, and the bars they are held to.
//!
//! `cargo run --release -p casteljau-domain --example harmonic_bars [RUNS]` prints for every golden the number of sides,
//! and by default and by high accuracy the certificate, the largest error of a value and the set-up time (least of RUNS,
//! 5 unless told); then the medians over the goldens of 6 to 8 sides and the rates of evaluation.
//!
//! Bars: a certificate of 1e-8 in a median of 30 ms, of 1e-10 in 100 ms, any golden in 2 s; 0.5 million points a second
//! with gradients on one thread.

use std::error::Error;
use std::path::PathBuf;
use std::time::Instant;

use casteljau_domain::glam::{DVec2, dvec2};
use casteljau_domain::{Coordinates, HarmonicOptions, Location, Polygon};
use serde_json::Value;

type Outcome<T> = Result<T, Box<dyn Error>>;

struct Golden {
    name: String,
    polygon: Polygon,
    points: Vec<(DVec2, Vec<f64>)>,
}

fn numbers(value: &Value) -> Outcome<Vec<f64>> {
    let list = value.as_array().ok_or("a list of numbers is missing")?;
    list.iter().map(|x| x.as_f64().ok_or_else(|| "not a number".into())).collect()
}

fn pair(value: &Value) -> Outcome<DVec2> {
    match numbers(value)?[..] {
        [x, y] => Ok(dvec2(x, y)),
        _ => Err("two numbers make a point".into()),
    }
}

fn goldens() -> Outcome<Vec<Golden>> {
    let mut all = Vec::new();
    for (folder, outline, exact) in [("coords", "polygon", "/lambda"), ("concave", "domain", "/exact/bary")] {
        let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../../shared/goldens/gb").join(folder);
        let Ok(entries) = path.read_dir() else { continue };
        let mut files: Vec<PathBuf> = entries.map(|e| Ok(e?.path())).collect::<Outcome<_>>()?;
        files.sort();
        for file in files {
            let case: Value = serde_json::from_str(&std::fs::read_to_string(&file)?)?;
            let vertices =
                case[outline].as_array().ok_or("no outline")?.iter().map(pair).collect::<Outcome<_>>()?;
            let point = |p: &Value| Ok((pair(&p["uv"])?, numbers(p.pointer(exact).unwrap_or(&Value::Null))?));
            let points =
                case["points"].as_array().ok_or("no points")?.iter().map(point).collect::<Outcome<_>>()?;
            let name = format!("{folder}/{}", case["id"].as_str().unwrap_or("?"));
            all.push(Golden { name, polygon: Polygon::new(vertices)?, points });
        }
    }
    Ok(all)
}

/// Coordinates, and the least milliseconds of a set-up.
fn set_up(polygon: &Polygon, options: &HarmonicOptions, runs: usize) -> Outcome<(Coordinates, f64)> {
    let mut best = f64::INFINITY;
    let mut last = None;
    for _ in 0..runs.max(1) {
        let polygon = polygon.clone();
        let start = Instant::now();
        last = Some(Coordinates::harmonic(polygon, options)?);
        best = best.min(start.elapsed().as_secs_f64() * 1e3);
    }
    Ok((last.ok_or("no run")?, best))
}

/// Largest error of a value at the golden's points, boundary points included, by plain evaluation.
fn error(golden: &Golden, coordinates: &Coordinates) -> Outcome<f64> {
    let mut worst = 0.0_f64;
    let mut row = vec![0.0; coordinates.len()];
    for (p, exact) in &golden.points {
        coordinates.evaluate_inside(&[*p], 0, &mut row)?;
        worst = row.iter().zip(exact).map(|(a, b)| (a - b).abs()).fold(worst, f64::max);
    }
    Ok(worst)
}

/// Million points a second, values, gradients and second derivatives: most of `runs` batches.
fn rates(coordinates: &Coordinates, runs: usize) -> Outcome<[f64; 3]> {
    const COUNT: usize = 2000;
    let polygon = coordinates.polygon();
    let [low, high] = polygon.bounding_box();
    // A sequence that fills the box evenly.
    let at = |k: u32| {
        low + (high - low) * dvec2(f64::from(k) * 0.754_877_666, f64::from(k) * 0.569_840_291).fract()
    };
    let inside = (1..).map(at).filter(|p| matches!(polygon.locate(*p), Location::Inside(_)));
    let points: Vec<DVec2> = inside.take(COUNT).collect();
    let mut out = vec![0.0; COUNT * coordinates.stride(2)];
    let mut rates = [0.0_f64; 3];
    for (order, rate) in rates.iter_mut().enumerate() {
        for _ in 0..4 * runs {
            let start = Instant::now();
            coordinates.evaluate_inside(&points, order, &mut out[..COUNT * coordinates.stride(order)])?;
            *rate = rate.max(COUNT as f64 / start.elapsed().as_secs_f64() / 1e6);
        }
    }
    Ok(rates)
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    let half = values.len() / 2;
    if values.len() % 2 == 1 { values[half] } else { 0.5 * (values[half - 1] + values[half]) }
}

fn main() -> Outcome<()> {
    let runs = std::env::args().nth(1).map_or(Ok(5), |a| a.parse())?;
    let goldens = goldens()?;
    if goldens.is_empty() {
        println!("goldens are absent, nothing to measure");
        return Ok(());
    }
    println!(
        "{:29} sides |        default (1e-8)        |    high accuracy (1e-10)     |   million points/s",
        ""
    );
    println!(
        "{:29}       |  certif.    error         ms |  certif.    error         ms | value  grad  second",
        "golden"
    );
    let (mut times, mut slowest, mut worst) = ([Vec::new(), Vec::new()], 0.0_f64, [0.0_f64; 2]);
    let mut gradients = Vec::new();
    for golden in &goldens {
        let n = golden.polygon.len();
        let mut line = format!("{:29} {n:5} |", golden.name);
        let mut speed = String::new();
        for (which, options) in
            [HarmonicOptions::default(), HarmonicOptions::high_accuracy()].iter().enumerate()
        {
            let (coordinates, ms) = set_up(&golden.polygon, options, runs)?;
            let error = error(golden, &coordinates)?;
            line += &format!(" {:8.1e} {error:8.1e} {ms:10.2} |", coordinates.certificate());
            slowest = slowest.max(ms);
            worst[which] = worst[which].max(error);
            if (6..=8).contains(&n) {
                times[which].push(ms);
            }
            if which == 0 {
                let [values, first, second] = rates(&coordinates, runs)?;
                speed = format!(" {values:5.2} {first:5.2} {second:7.2}");
                gradients.push(first);
            }
        }
        println!("{line}{speed}");
    }
    let [default, high] = times.map(median);
    println!(
        "\nmedian set-up, 6 to 8 sides: {default:.1} ms by default (bar 30), {high:.1} ms by high accuracy (bar 100)"
    );
    println!("slowest set-up: {slowest:.0} ms (bar 2000)");
    println!("largest error: {:.1e} by default (bar 1e-8), {:.1e} by high accuracy", worst[0], worst[1]);
    let least = gradients.iter().copied().fold(f64::INFINITY, f64::min);
    println!(
        "points with gradients: {least:.2} million/s at least, {:.2} median (bar 0.5)",
        median(gradients)
    );
    Ok(())
}
