//! MATLAB files of version 7.3: structures and cells whose references lead astray.

use crate::hdf5_files::file_with;
use crate::read_without;
use hdf5::types::FixedAscii;
use hdf5::{File, ObjectReference, ObjectReference1};

/// A data set of references, of a class of MATLAB.
fn references(file: &File, name: &str, class: &str, to: &[&str]) {
    let found: Vec<ObjectReference1> =
        to.iter().map(|path| ObjectReference1::create(file, path).unwrap()).collect();
    let data = file.new_dataset::<ObjectReference1>().shape(to.len()).create(name).unwrap();
    data.write_raw(&found).unwrap();
    let class = FixedAscii::<16>::from_ascii(class.as_bytes()).unwrap();
    data.new_attr::<FixedAscii<16>>().create("MATLAB_class").unwrap().write_scalar(&class).unwrap();
}

#[test]
fn a_cell_within_itself() {
    let (_folder, path) = file_with(|file| {
        file.create_group("#refs#").unwrap();
        // A cell can refer to what exists: it refers to a group that has a link back to it.
        file.create_group("#refs#/g").unwrap();
        references(file, "#refs#/a", "cell", &["/#refs#/g", "/#refs#/g"]);
        file.link_hard("/#refs#/a", "#refs#/g/back").unwrap();
        file.link_hard("/#refs#", "#refs#/g/all").unwrap();
        references(file, "c", "cell", &["/#refs#/a", "/#refs#/a", "/#refs#/g"]);
    });
    read_without(&path, &["c{2} (c{1} again)"]);
}

/// Two references from every cell to the next: without a mark of those seen, 2^60 visits.
#[test]
fn cells_reached_in_two_ways() {
    let (_folder, path) = file_with(|file| {
        file.create_group("#refs#").unwrap();
        file.create_group("#refs#/c60").unwrap();
        for k in (0..60).rev() {
            let next = format!("/#refs#/c{}", k + 1);
            references(file, &format!("#refs#/c{k}"), "cell", &[&next, &next]);
        }
        references(file, "c", "cell", &["/#refs#/c0"]);
    });
    read_without(&path, &["again)"]);
}

#[test]
fn cells_of_great_depth() {
    let (_folder, path) = file_with(|file| {
        file.create_group("#refs#").unwrap();
        file.create_group("#refs#/c1000").unwrap();
        for k in (0..1000).rev() {
            references(file, &format!("#refs#/c{k}"), "cell", &[&format!("/#refs#/c{}", k + 1)]);
        }
        references(file, "c", "cell", &["/#refs#/c0"]);
    });
    read_without(&path, &["(more than 64 structures or cells deep)"]);
}

#[test]
fn references_to_nothing_and_out_of_place() {
    let (_folder, path) = file_with(|file| {
        file.create_group("#refs#/g").unwrap();
        // Never written: null references.
        file.new_dataset::<ObjectReference1>().shape(3).create("null").unwrap();
        references(file, "astray", "cell", &["/wave"]);
    });
    let parts =
        ["astray{1} (a reference to nothing in #refs#)", "null{3} (a reference to nothing in #refs#)"];
    read_without(&path, &parts);
}

#[test]
fn references_without_number() {
    let (_folder, path) = file_with(|file| {
        file.create_group("#refs#/g").unwrap();
        let new = || file.new_dataset::<ObjectReference1>().chunk(1000);
        new().shape(1_000_000_000_000_usize).create("many").unwrap();
        new().shape(300_000).create("some").unwrap();
    });
    read_without(&path, &["/many (it would need 24 TB", "/some (it would need 300000 references or more"]);
}

/// A name of 30 kB for every element would be 3 GB.
#[test]
fn a_long_name_of_many_elements() {
    let (_folder, path) = file_with(|file| {
        file.create_group("#refs#").unwrap();
        file.create_group("#refs#/g").unwrap();
        references(file, &"n".repeat(30_000), "cell", &vec!["/#refs#/g"; 90_000]);
    });
    read_without(&path, &["the names of its elements would need 5.41 GB", "--read-limit"]);
}
