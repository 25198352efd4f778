//! HDF5 files of others.

use crate::{read_without, refused, run};
use hdf5::File;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// A file with one sound channel, to which `add` adds something else.
pub fn file_with(add: impl FnOnce(&File)) -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.h5");
    let file = File::create(&path).unwrap();
    let wave: Vec<f64> = (0..4096).map(|k| (0.1 * f64::from(k)).sin()).collect();
    let data = file.new_dataset_builder().with_data(&wave).create("wave").unwrap();
    data.new_attr::<f64>().create("fs").unwrap().write_scalar(&1000.0).unwrap();
    add(&file);
    drop(data);
    file.close().unwrap();
    (folder, path)
}

#[test]
fn groups_within_themselves() {
    let (_folder, path) = file_with(|file| {
        file.create_group("a").unwrap();
        file.link_hard("/a", "a/hard").unwrap();
        file.link_soft("/a", "a/soft").unwrap();
        file.link_soft("/", "a/root").unwrap();
    });
    read_without(
        &path,
        &["/a/hard (the group /a again)", "/a/soft (the group /a again)", "/a/root (the group / again)"],
    );
}

/// Two ways from every group to the next: without a mark of the groups seen, 2^40 visits.
#[test]
fn groups_reached_in_two_ways() {
    let (_folder, path) = file_with(|file| {
        for k in (0..40).rev() {
            file.create_group(&format!("g{k}")).unwrap();
            if k < 39 {
                file.link_hard(&format!("/g{}", k + 1), &format!("g{k}/a")).unwrap();
                file.link_hard(&format!("/g{}", k + 1), &format!("g{k}/b")).unwrap();
            }
        }
    });
    read_without(&path, &["again)"]);
}

#[test]
fn groups_of_great_depth() {
    let (_folder, path) = file_with(|file| {
        let mut group = file.create_group("deep").unwrap();
        for _ in 0..3000 {
            group = group.create_group("g").unwrap();
        }
    });
    read_without(&path, &["(more than 64 groups deep)"]);
}

#[test]
fn data_sets_of_1e12_values() {
    let (_folder, path) = file_with(|file| {
        let new = || file.new_dataset::<f64>();
        new().chunk(1000).shape(1_000_000_000_000_usize).create("chunked").unwrap();
        new().shape(1_000_000_000_000_usize).create("whole").unwrap();
    });
    let parts = ["/chunked (it would need 8 TB", "/whole (it would need 8 TB", "--read-limit 10TB"];
    read_without(&path, &parts);
}

#[test]
fn links_that_lead_nowhere() {
    let (_folder, path) = file_with(|file| {
        file.link_soft("/nothing/at/all", "dangling").unwrap();
        file.link_soft("loop", "loop").unwrap();
        file.create_group("g").unwrap();
        file.link_soft("../wave", "g/up").unwrap();
    });
    read_without(
        &path,
        &["/dangling (a link to nothing)", "/loop (a link to nothing)", "/g/up (a link to nothing)"],
    );
}

/// A file that is read must not read others, which a message or a result could give away.
#[test]
fn data_in_other_files() {
    let secret = tempfile::tempdir().unwrap();
    let other = secret.path().join("other.h5");
    let numbers: Vec<f64> = vec![31.41592; 100];
    File::create(&other).unwrap().new_dataset_builder().with_data(&numbers).create("x").unwrap();
    let name = other.to_str().unwrap();
    let (folder, path) = file_with(|file| {
        file.link_external(name, "/x", "link").unwrap();
        file.link_soft("/link", "way_round").unwrap();
        file.new_dataset::<u8>().external("/etc/passwd", 0, 100).shape(100).create("raw").unwrap();
        let map = file.new_dataset::<f64>().shape(100).virtual_map(name, "x", 100, .., 100, ..);
        map.create("virtual").unwrap();
    });
    let in_others = "its values are in other files, which are not read";
    let parts = [
        "/link (a link to another file)",
        "/way_round (a link to nothing)",
        &format!("/raw ({in_others})"),
        &format!("/virtual ({in_others})"),
    ];
    read_without(&path, &parts);
    // Nor by name.
    let seen = run(&["signal", path.to_str().unwrap(), "--channel", "way_round"]);
    assert_eq!(seen.code, Some(2), "{}", seen.reported);
    drop(folder);
}

#[test]
fn values_whose_checksum_does_not_fit() {
    let mark = 12345.678_f64;
    let (_folder, path) = file_with(|file| {
        let values: Vec<f64> = (0..4096).map(|k| mark + f64::from(k)).collect();
        let builder = file.new_dataset_builder().chunk(512).fletcher32();
        builder.with_data(&values).create("summed").unwrap();
        let builder = file.new_dataset_builder().chunk(512).deflate(4);
        builder.with_data(&values).create("packed").unwrap();
    });
    let mut bytes = std::fs::read(&path).unwrap();
    let at = bytes.windows(8).position(|w| w == mark.to_le_bytes()).unwrap();
    bytes[at + 100] ^= 4;
    let packed = bytes.windows(2).rposition(|w| w == [0x78, 0x5e]).unwrap();
    bytes[packed + 20..packed + 30].fill(0xaa);
    std::fs::write(&path, bytes).unwrap();
    read_without(&path, &["/summed (", "/packed ("]);
}

#[test]
fn many_links_to_one_data_set() {
    let (_folder, path) = file_with(|file| {
        let values: Vec<f64> = vec![0.5; 1_000_000];
        file.new_dataset_builder().chunk(10_000).deflate(9).with_data(&values).create("v").unwrap();
        (0..1000).for_each(|k| file.link_hard("/v", &format!("v{k}")).unwrap());
    });
    refused(&path, &["would need", "--read-limit"]);
}

#[test]
fn what_is_no_hdf5_behind_its_signature() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.h5");
    let signature = b"\x89HDF\r\n\x1a\n";
    for rest in [&[0_u8; 0][..], &[0; 600], &[0xff; 5000]] {
        std::fs::write(&path, [&signature[..], rest].concat()).unwrap();
        refused(&path, &["the HDF5 library does not open it"]);
    }
}

/// Every byte of a small file in turn: whatever the HDF5 library does, the program ends with a message.
#[test]
fn damaged_files_end_with_a_message() {
    let (folder, path) = file_with(|file| {
        file.create_group("g").unwrap();
        let values: Vec<f64> = (0..64).map(f64::from).collect();
        file.new_dataset_builder().chunk(16).deflate(1).with_data(&values).create("g/packed").unwrap();
    });
    let bytes = std::fs::read(&path).unwrap();
    let damaged = folder.path().join("damaged.h5");
    // A fixed choice; the metadata is in the first 2 kB and behind the samples.
    let places = (8..2048).chain(4096 * 8..bytes.len()).step_by(61);
    let mut codes = std::collections::BTreeMap::new();
    for at in places.filter(|at| *at < bytes.len()) {
        let mut changed = bytes.clone();
        changed[at] ^= [0xff, 0x80, 0x01][at % 3];
        std::fs::write(&damaged, changed).unwrap();
        let seen = run(&["signal", damaged.to_str().unwrap()]);
        assert!(matches!(seen.code, Some(0 | 2)), "byte {at}: {:?} {}", seen.code, seen.reported);
        assert!(seen.memory < 300_000_000 && seen.cpu < 5.0, "byte {at}: {} {}", seen.memory, seen.cpu);
        *codes.entry(seen.code).or_insert(0) += 1;
    }
    assert!(codes[&Some(2)] > 3, "{codes:?}");
}

/// Files on which the HDF5 library of this version crashes or comes to no end, found by changing bytes of sound ones.
#[test]
fn crash_of_the_library_is_an_error_of_the_file() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/hostile");
    let mut files: Vec<PathBuf> = std::fs::read_dir(folder).unwrap().map(|f| f.unwrap().path()).collect();
    files.retain(|path| path.extension().is_some_and(|e| e == "h5"));
    files.sort();
    assert!(!files.is_empty());
    for path in files {
        let seen = run(&["signal", path.to_str().unwrap()]);
        assert_eq!(seen.code, Some(2), "{}: {}", path.display(), seen.reported);
        assert!(seen.reported.contains("the HDF5 library"), "{}: {}", path.display(), seen.reported);
        assert!(seen.reported.contains("(signal "), "{}: {}", path.display(), seen.reported);
        println!("{}: {:.2} s, {:.0} MB", path.display(), seen.cpu, 1e-6 * seen.memory as f64);
        // A loop ends after half a second, and a little for the size of the file.
        assert!(seen.cpu < 1.0 && seen.memory < 200_000_000, "{} s, {} bytes", seen.cpu, seen.memory);
    }
}
