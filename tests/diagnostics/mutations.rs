//! Mutated model files never make the reader panic, and every error span lies within the text.

use rotordyn::model::{self, Options};

const FILES: [&str; 6] = [
    include_str!("../../models/overhung_rig.toml"),
    include_str!("../../models/nelson_mcvaugh.toml"),
    include_str!("../../models/jeffcott.toml"),
    include_str!("../../models/two_disc_pedestals.toml"),
    include_str!("../../models/bal_2022.toml"),
    include_str!("../../models/zhang_2016.toml"),
];

const VALUES: [&str; 12] = [
    "0",
    "-1",
    "nan",
    "inf",
    "true",
    "\"\"",
    "\"-1 mm\"",
    "\"1e300 m\"",
    "\"A\"",
    "[]",
    "{}",
    "\"0, 0, 0 mm\"",
];

/// Every line deleted, and every value replaced by each of `VALUES`.
#[test]
fn mutated_lines_never_panic() {
    let (mut read, mut refused) = (0, 0);
    for text in FILES {
        let lines: Vec<&str> = text.lines().collect();
        let variants: Vec<Option<String>> =
            std::iter::once(None).chain(model::variants(text).into_iter().take(1).map(Some)).collect();
        for (k, line) in lines.iter().enumerate() {
            let key = line.split_once(" = ").map(|(key, _)| key);
            let replacements = VALUES.iter().filter_map(|v| key.map(|key| format!("{key} = {v}")));
            for line in replacements.chain([String::new()]) {
                let mut mutated = lines.clone();
                mutated[k] = &line;
                let mutated = mutated.join("\n");
                for variant in &variants {
                    match model::load(
                        "m",
                        &mutated,
                        &Options { variant: variant.clone(), ..Options::default() },
                    ) {
                        Ok(_) => read += 1,
                        Err(errors) => {
                            refused += 1;
                            for d in &errors.diagnostics {
                                assert!(
                                    d.span.start <= d.span.end && d.span.end <= mutated.len(),
                                    "{line}: {d:?}"
                                );
                                assert!(mutated.get(d.span.clone()).is_some(), "{line}: {d:?}");
                            }
                        }
                    }
                }
            }
        }
    }
    assert!(read > 100 && refused > 5000, "{read} read, {refused} refused");
}
