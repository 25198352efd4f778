//! Every file under models/ loads with every variant, without errors and warnings.

use rotordyn::model::{self, Options};

#[test]
fn every_model_and_variant_loads_without_warnings() {
    let mut count = 0;
    for file in std::fs::read_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/models")).unwrap() {
        let path = file.unwrap().path();
        if path.extension().is_none_or(|e| e != "toml") {
            continue;
        }
        let text = std::fs::read_to_string(&path).unwrap();
        let variants = model::variants(&text).into_iter().map(Some);
        for variant in std::iter::once(None).chain(variants) {
            let options = Options { variant: variant.clone(), ..Options::default() };
            let loaded = model::load(&path.to_string_lossy(), &text, &options);
            let loaded =
                loaded.unwrap_or_else(|e| panic!("{} {variant:?}: {:#?}", path.display(), e.diagnostics));
            assert_eq!(loaded.warnings, [], "{} {variant:?}", path.display());
            assert_eq!(Some(loaded.model.name.as_str()), path.file_stem().and_then(|s| s.to_str()));
            count += 1;
        }
    }
    assert!(count >= 16, "{count}");
}
