//! Identity of a run: a digest of all that its results follow from, equal for equal input.

use rotordyn_core::model::ExternalFile;
use siphasher::sip128::{Hasher128, SipHasher};
use std::hash::Hasher;

/// The identity of a run, 32 hexadecimal digits: SipHash 2-4 (128 bits, key 0) of model text, variant, settings
/// "path = value", side files and the version of the program.
pub fn run_identity(model: &[u8], variant: &str, settings: &[String], files: &[ExternalFile]) -> String {
    let mut digest = SipHasher::new();
    // With its length before each part, no two lists of parts give the same bytes.
    let mut add = |part: &[u8]| {
        digest.write(&(part.len() as u64).to_le_bytes());
        digest.write(part);
    };
    add(env!("CARGO_PKG_VERSION").as_bytes());
    add(model);
    add(variant.as_bytes());
    add(&(settings.len() as u64).to_le_bytes());
    settings.iter().for_each(|setting| add(setting.as_bytes()));
    for file in files {
        add(file.path.as_bytes());
        // A file that cannot be read has no columns; the model is then refused.
        for column in file.content.iter().flatten() {
            add(column.name.as_bytes());
            add(column.unit.as_bytes());
            let values: Vec<u8> = column.values.iter().flat_map(|value| value.to_le_bytes()).collect();
            add(&values);
        }
    }
    format!("{:032x}", digest.finish128().as_u128())
}

#[cfg(test)]
mod tests {
    use super::*;
    use rotordyn_core::model::ExternalColumn;

    #[test]
    fn every_part_changes_the_identity() {
        let file = |value: f64| ExternalFile {
            path: "speed.csv".into(),
            content: Ok(vec![ExternalColumn { name: "t".into(), unit: "s".into(), values: vec![value] }]),
        };
        let list = |texts: &[&str]| texts.iter().map(|text| text.to_string()).collect::<Vec<_>>();
        let all = [
            run_identity(b"ab", "", &[], &[]),
            run_identity(b"a", "b", &[], &[]),
            run_identity(b"ab", "", &list(&["x = 1"]), &[]),
            run_identity(b"ab", "", &list(&["x = 1", ""]), &[]),
            run_identity(b"ab", "", &list(&["x = ", "1"]), &[]),
            run_identity(b"ab", "", &[], &[file(1.0)]),
            run_identity(b"ab", "", &[], &[file(1.0 + f64::EPSILON)]),
        ];
        for (k, one) in all.iter().enumerate() {
            assert_eq!(one.len(), 32);
            assert!(!all[..k].contains(one), "{k}");
        }
        assert_eq!(all[5], run_identity(b"ab", "", &[], &[file(1.0)]));
    }
}
