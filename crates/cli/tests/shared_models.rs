//! The models that the project shares but does not own: all that can be read is measured, meshed and drawn.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod support;

use support::{casteljau, path, shared_models};

#[test]
fn every_cgb_goes_all_the_way() {
    let Some(folder) = shared_models() else { return };
    let out = tempfile::tempdir().unwrap();
    for name in ["L.cgb", "U.cgb", "v31.cgb"] {
        let model = path(&folder.join(name));
        let info = casteljau(&["info", &model, "--json"]);
        assert_eq!(info.status, 0, "{name}: {}", info.err);
        assert_eq!(info.json().len(), 1);
        let mesh = path(&out.path().join("mesh.ply"));
        let run = casteljau(&["mesh", &model, "-o", &mesh, "--json"]);
        assert_eq!(run.status, 0, "{name}: {}", run.err);
        assert!(run.json()[0]["triangles"].as_u64().unwrap() > 100);
        let check = casteljau(&["check", &model, "--json"]);
        assert_eq!(check.status, 0, "{name}: {}{}", check.out, check.err);
        let picture = path(&out.path().join("picture.svg"));
        for domain in [&["--domain"][..], &[]] {
            let run = casteljau(&[&["plot", &model, "-o", &picture], domain].concat());
            assert_eq!(run.status, 0, "{name}: {}", run.err);
        }
    }
}
