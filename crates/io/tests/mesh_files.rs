//! Meshes written in every format and read back by independent readers.
#![allow(clippy::unwrap_used, clippy::panic, clippy::unreachable)]

use std::io::Cursor;
use std::path::Path;

use casteljau_io::{IoError, Reason, obj, off, ply, replace_file, stl, write_mesh_file};
use casteljau_mesh::TriangleMesh;
use casteljau_mesh::glam::{DVec3, dvec3};
use proptest::prelude::*;

/// Numbers of a line, after so many words.
fn numbers(line: &str, skip: usize) -> Vec<f64> {
    line.split(' ').skip(skip).map(|word| word.parse().unwrap()).collect()
}

fn read_obj(text: &str) -> TriangleMesh {
    let mut mesh = TriangleMesh::default();
    for line in text.lines() {
        match line.split(' ').next().unwrap() {
            "v" => mesh.positions.push(DVec3::from_slice(&numbers(line, 1))),
            "vn" => mesh.normals.push(DVec3::from_slice(&numbers(line, 1))),
            "f" => {
                let corner = |word: &str| {
                    let (vertex, normal) = word.split_once("//").unwrap_or((word, word));
                    assert_eq!(vertex, normal);
                    vertex.parse::<u32>().unwrap() - 1
                };
                let corners: Vec<u32> = line.split(' ').skip(1).map(corner).collect();
                mesh.triangles.push(corners.try_into().unwrap());
            }
            word => panic!("{word}"),
        }
    }
    mesh
}

/// Vertices and triangles as OFF and text PLY have them.
fn read_body<'t>(
    lines: &mut impl Iterator<Item = &'t str>,
    vertices: usize,
    triangles: usize,
) -> TriangleMesh {
    let mut mesh = TriangleMesh::default();
    for _ in 0..vertices {
        let values = numbers(lines.next().unwrap(), 0);
        mesh.positions.push(DVec3::from_slice(&values[..3]));
        if values.len() == 6 {
            mesh.normals.push(DVec3::from_slice(&values[3..]));
        }
    }
    for _ in 0..triangles {
        let words: Vec<u32> = lines.next().unwrap().split(' ').map(|word| word.parse().unwrap()).collect();
        assert_eq!(words[0], 3);
        mesh.triangles.push([words[1], words[2], words[3]]);
    }
    assert!(lines.next().is_none());
    mesh
}

fn read_off(text: &str) -> TriangleMesh {
    let mut lines = text.lines();
    let magic = lines.next().unwrap();
    let counts = numbers(lines.next().unwrap(), 0);
    let mesh = read_body(&mut lines, counts[0] as usize, counts[1] as usize);
    assert_eq!(magic, if mesh.normals.is_empty() { "OFF" } else { "NOFF" });
    mesh
}

fn read_ply(bytes: &[u8]) -> TriangleMesh {
    let end = b"end_header\n";
    let start = bytes.windows(end.len()).position(|window| window == end).unwrap() + end.len();
    let header = str::from_utf8(&bytes[..start]).unwrap();
    let count = |what: &str| -> usize {
        header.lines().find_map(|line| line.strip_prefix(&format!("element {what} "))?.parse().ok()).unwrap()
    };
    let (vertices, triangles) = (count("vertex"), count("face"));
    let properties: Vec<&str> =
        header.lines().filter_map(|line| line.strip_prefix("property double ")).collect();
    let normals = properties.len() == 6;
    assert_eq!(properties, ["x", "y", "z", "nx", "ny", "nz"][..properties.len()]);
    assert!(header.contains("property list uchar uint vertex_indices\n"));
    let body = &bytes[start..];
    if header.contains("format ascii 1.0\n") {
        return read_body(&mut str::from_utf8(body).unwrap().lines(), vertices, triangles);
    }
    assert!(header.contains("format binary_little_endian 1.0\n"));
    let width = if normals { 48 } else { 24 };
    let (points, faces) = body.split_at(vertices * width);
    let mut mesh = TriangleMesh::default();
    for vertex in points.chunks_exact(width) {
        let values: Vec<f64> =
            vertex.chunks_exact(8).map(|b| f64::from_le_bytes(b.try_into().unwrap())).collect();
        mesh.positions.push(DVec3::from_slice(&values[..3]));
        if normals {
            mesh.normals.push(DVec3::from_slice(&values[3..]));
        }
    }
    assert_eq!(faces.len(), 13 * triangles);
    for face in faces.chunks_exact(13) {
        assert_eq!(face[0], 3);
        let index = |i: usize| u32::from_le_bytes(face[1 + 4 * i..5 + 4 * i].try_into().unwrap());
        mesh.triangles.push([index(0), index(1), index(2)]);
    }
    mesh
}

fn point(limit: f64) -> impl Strategy<Value = DVec3> {
    let number = prop_oneof![
        any::<f64>().prop_map(move |x| if x.is_finite() { x % limit } else { -0.0 }),
        (-1000..1000_i32).prop_map(|n| f64::from(n) / 100.0),
        Just(0.0),
        Just(-0.0),
    ];
    [number.clone(), number.clone(), number].prop_map(DVec3::from)
}

fn mesh(limit: f64) -> impl Strategy<Value = TriangleMesh> {
    (1..20_usize, any::<bool>()).prop_flat_map(move |(vertices, with_normals)| {
        let normals = if with_normals { vertices } else { 0 };
        (
            prop::collection::vec(point(limit), vertices),
            prop::collection::vec(point(limit), normals),
            prop::collection::vec([0..vertices as u32, 0..vertices as u32, 0..vertices as u32], 0..20),
        )
            .prop_map(|(positions, normals, triangles)| TriangleMesh {
                positions,
                normals,
                triangles,
            })
    })
}

/// What a format's writer leaves in a buffer.
fn written(write: impl FnOnce(&mut Vec<u8>) -> Result<(), IoError>) -> Vec<u8> {
    let mut bytes = Vec::new();
    write(&mut bytes).unwrap();
    bytes
}

fn text(bytes: Vec<u8>) -> String {
    String::from_utf8(bytes).unwrap()
}

proptest! {
    #[test]
    fn formats_of_f64_come_back_to_the_bit(mesh in mesh(f64::MAX)) {
        let bits = format!("{mesh:?}");
        prop_assert_eq!(&format!("{:?}", read_obj(&text(written(|out| obj::write(&mesh, out))))), &bits);
        prop_assert_eq!(&format!("{:?}", read_off(&text(written(|out| off::write(&mesh, out))))), &bits);
        prop_assert_eq!(&format!("{:?}", read_ply(&written(|out| ply::write(&mesh, out)))), &bits);
        prop_assert_eq!(&format!("{:?}", read_ply(&written(|out| ply::write_ascii(&mesh, out)))), &bits);
    }

    #[test]
    fn stl_comes_back_to_f32(mesh in mesh(3e38)) {
        for bytes in [written(|out| stl::write(&mesh, out)), written(|out| stl::write_ascii(&mesh, out))] {
            let facets: Vec<_> = stl_io::create_stl_reader(&mut Cursor::new(bytes)).unwrap().map(Result::unwrap).collect();
            prop_assert_eq!(facets.len(), mesh.triangles.len());
            for (index, facet) in facets.iter().enumerate() {
                for (vertex, corner) in facet.vertices.iter().zip(mesh.corners(index).unwrap()) {
                    prop_assert_eq!(vertex.0, corner.to_array().map(|c| c as f32));
                }
                let normal = DVec3::from(facet.normal.0.map(f64::from));
                let [a, b, c] = mesh.corners(index).unwrap();
                let size = (b - a).abs().max((c - a).abs()).max_element();
                let area = ((b - a) / size).cross((c - a) / size);
                if area.is_finite() && area.length() > 1e-300 {
                    prop_assert!(normal.distance(area.normalize()) < 1e-6);
                } else {
                    prop_assert_eq!(normal, DVec3::ZERO);
                }
            }
        }
    }
}

fn triangle() -> TriangleMesh {
    TriangleMesh {
        positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y],
        triangles: vec![[0, 1, 2]],
        ..Default::default()
    }
}

#[test]
fn the_ending_chooses_and_nothing_is_left_beside() {
    let folder = tempfile::tempdir().unwrap();
    let mesh = triangle();
    for (name, start) in [("a.obj", "v 0.0"), ("a.OFF", "OFF\n"), ("a.ply", "ply\n"), ("a.stl", "casteljau")]
    {
        let path = folder.path().join(name);
        write_mesh_file(&path, &mesh).unwrap();
        assert!(std::fs::read(&path).unwrap().starts_with(start.as_bytes()), "{name}");
    }
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 4);
    let empty = folder.path().join("empty.stl");
    write_mesh_file(&empty, &TriangleMesh::default()).unwrap();
    assert_eq!(std::fs::metadata(&empty).unwrap().len(), 84);
}

#[test]
fn a_failure_leaves_the_old_file_and_no_other() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.stl");
    std::fs::write(&path, "old").unwrap();
    let mut bad = triangle();
    bad.positions[1] = dvec3(1e39, 0.0, 0.0);
    let error = write_mesh_file(&path, &bad).unwrap_err();
    assert!(matches!(&error, IoError::Invalid { reason: Reason::BeyondF32 { vertex: 1, value: 1e39 }, .. }));
    assert!(error.to_string().starts_with(&path.display().to_string()), "{error}");
    bad.positions[1] = DVec3::NAN;
    let error = write_mesh_file(&path, &bad).unwrap_err().to_string();
    assert!(error.starts_with(&path.display().to_string()) && error.contains("position 1"), "{error}");
    // A stream that breaks after the first bytes.
    let broken = replace_file(&path, |out| {
        out.write_all(&[0; 200_000])?;
        Err(std::io::Error::other("the disk is full").into())
    });
    assert_eq!(
        broken.unwrap_err().to_string(),
        format!("{}: cannot write: the disk is full", path.display())
    );
    assert_eq!(std::fs::read(&path).unwrap(), b"old");
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
}

#[test]
fn places_that_cannot_be_written_are_named() {
    let mesh = triangle();
    let error = write_mesh_file(Path::new("/no/such/folder/a.ply"), &mesh).unwrap_err().to_string();
    assert!(error.starts_with("/no/such/folder/a.ply: cannot create a file beside it: "), "{error}");
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.ply");
    std::fs::create_dir(&path).unwrap();
    assert!(matches!(write_mesh_file(&path, &mesh), Err(IoError::System { .. })));
}

#[cfg(unix)]
#[test]
fn links_and_permissions_stay() {
    use std::os::unix::fs::PermissionsExt;
    let folder = tempfile::tempdir().unwrap();
    let (target, link) = (folder.path().join("target.obj"), folder.path().join("link.obj"));
    std::fs::write(&target, "old").unwrap();
    std::fs::set_permissions(&target, std::fs::Permissions::from_mode(0o640)).unwrap();
    std::os::unix::fs::symlink(&target, &link).unwrap();
    write_mesh_file(&link, &triangle()).unwrap();
    assert!(std::fs::symlink_metadata(&link).unwrap().is_symlink());
    assert!(std::fs::read(&target).unwrap().starts_with(b"v "));
    assert_eq!(std::fs::metadata(&target).unwrap().permissions().mode() & 0o777, 0o640);
    // A new file is everybody's to read, as far as the umask lets it be.
    let plain = folder.path().join("plain");
    std::fs::write(&plain, "").unwrap();
    let new = folder.path().join("new.obj");
    write_mesh_file(&new, &triangle()).unwrap();
    assert_eq!(
        std::fs::metadata(&new).unwrap().permissions(),
        std::fs::metadata(&plain).unwrap().permissions()
    );
    // A device is written to, not replaced.
    let device = folder.path().join("null.obj");
    std::os::unix::fs::symlink("/dev/null", &device).unwrap();
    write_mesh_file(&device, &triangle()).unwrap();
    assert!(!std::fs::metadata("/dev/null").unwrap().is_file());
}
