//! Tables of EHL (elastohydrodynamic) films, computed when a model needs them and cached on disk by their
//! inputs.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::atomic_file;
use crate::budget::{self, Limits};
use crate::csv::{self, Column};
use crate::error::{Error, PhysicsError};
use rotordyn_bearing::BallBearing;
use rotordyn_bearing::contact::ContactLaw;
use rotordyn_bearing::contact::ehl::{EhlError, Films, Solution, SolvedContacts, Table, TableSpec};

/// Cache folder: `ROTORDYN_CACHE`, or `rotordyn` in the user's cache folder; `None` without either.
pub fn cache_folder() -> Option<PathBuf> {
    let variable = |name| std::env::var_os(name).filter(|v| !v.is_empty()).map(PathBuf::from);
    variable("ROTORDYN_CACHE")
        .or_else(|| Some(variable("XDG_CACHE_HOME")?.join("rotordyn")))
        .or_else(|| Some(variable("HOME")?.join(".cache").join("rotordyn")))
}

/// Computes the tables of a bearing with an EHL film, or reads them from `cache`; other bearings are
/// unchanged. Every contact that is solved is kept in `cache` at once: an interrupted table continues where it was.
///
/// `progress(race, done, total)` is called after every contact that is solved, from any thread.
///
/// # Errors
/// [`PhysicsError::Film`] when a contact does not converge: its last fields are then written to `last`, as
/// CSV. A cache that cannot be written is not an error: the tables are then computed again next time.
pub fn load_or_compute(
    name: &str,
    bearing: &mut BallBearing,
    cache: Option<&Path>,
    last: &Path,
    progress: &(impl Fn(&str, usize, usize) + Sync),
) -> Result<(), Error> {
    let hertz = bearing.hertz();
    let ContactLaw::Ehl(law) = &mut bearing.contact else { return Ok(()) };
    if law.tables.is_some() {
        return Ok(());
    }
    let [inner, outer] = law.specs(&hertz);
    let table = |race: &str, spec: &TableSpec| -> Result<Table, Error> {
        if let Some(known) = cache.and_then(|folder| read(folder, &spec.key())) {
            return Ok(known);
        }
        let count = |done, total| progress(race, done, total);
        let found = match cache {
            Some(folder) => spec.compute_with(&ContactFolder(folder), count),
            None => spec.compute(count),
        };
        let table = found.map_err(|failure| film_error(name, race, &failure, last))?;
        if let Some(folder) = cache
            && write(folder, &table)
        {
            for key in spec.contact_keys() {
                let _ = std::fs::remove_file(cache_file(folder, "contact", &key));
            }
        }
        Ok(table)
    };
    law.tables = Some(Arc::new([table("inner", &inner)?, table("outer", &outer)?]));
    Ok(())
}

/// The error of a film; the last fields of a contact that did not converge are written to the file `last`.
fn film_error(name: &str, race: &str, failure: &EhlError, last: &Path) -> Error {
    let mut reason = failure.to_string();
    if let EhlError::NoConvergence { last: fields, .. } = failure {
        if let Some(folder) = last.parent() {
            let _ = std::fs::create_dir_all(folder);
        }
        reason += &match write_fields(fields, last) {
            Ok(()) => format!("; its last fields are in {}", last.display()),
            Err(error) => format!("; its last fields could not be written: {error}"),
        };
    }
    PhysicsError::Film { bearing: name.into(), race: race.into(), reason }.into()
}

/// Pressure and film over x and y as a table of four columns.
///
/// # Errors
/// As [`csv::write`].
pub fn write_fields(fields: &Solution, path: &Path) -> Result<(), Error> {
    let ny = fields.y.len();
    let x: Vec<f64> = fields.x.iter().flat_map(|&x| std::iter::repeat_n(x, ny)).collect();
    let y: Vec<f64> = fields.x.iter().flat_map(|_| fields.y.iter().copied()).collect();
    let column = |name, unit, values| Column { name, unit, values };
    csv::write(
        path,
        &[
            column("x", "m", &x),
            column("y", "m", &y),
            column("pressure", "Pa", &fields.pressure),
            column("film", "m", &fields.film),
        ],
    )
}

fn cache_file(folder: &Path, kind: &str, key: &str) -> PathBuf {
    // FNV-1a hash: short and stable; the key inside the file is decisive.
    let hash = key.bytes().fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
    });
    folder.join(format!("{kind}-{hash:016x}.json"))
}

/// Reads the table of a key from the cache; `None` if missing or damaged.
fn read(folder: &Path, key: &str) -> Option<Table> {
    let (text, _) = budget::read_file(&cache_file(folder, "film", key), &Limits::default()).ok()?;
    let table: Table = serde_json::from_slice(&text).ok()?;
    (table.key == key && is_complete(&table)).then_some(table)
}

/// Whether every array has a value for each load and speed.
fn is_complete(table: &Table) -> bool {
    let full = |rows: &[Vec<f64>]| {
        rows.len() == table.speeds.len() && rows.iter().all(|row| row.len() == table.loads.len())
    };
    let arrays = [&table.shift, &table.central_film, &table.minimum_film];
    let numbers = || arrays.into_iter().flatten().flatten().chain(&table.loads).chain(&table.speeds);
    !table.loads.is_empty()
        && !table.speeds.is_empty()
        && arrays.into_iter().all(|rows| full(rows))
        && numbers().all(|value| value.is_finite())
}

/// Whether the table could be written.
fn write(folder: &Path, table: &Table) -> bool {
    write_whole(folder, &cache_file(folder, "film", &table.key), table)
}

/// Writes a file as a whole, so that no reader sees an incomplete one; whether it was written.
fn write_whole(folder: &Path, path: &Path, content: &impl serde::Serialize) -> bool {
    std::fs::create_dir_all(folder)
        .and_then(|()| serde_json::to_vec(content).map_err(std::io::Error::other))
        .and_then(|text| atomic_file::write_derived(path, &text))
        .is_ok()
}

/// Solved contacts of unfinished tables: one small file each.
struct ContactFolder<'a>(&'a Path);

#[derive(Serialize, Deserialize)]
struct SolvedContact {
    key: String,
    films: Films,
}

impl SolvedContacts for ContactFolder<'_> {
    fn find(&self, key: &str) -> Option<Films> {
        let (text, _) = budget::read_file(&cache_file(self.0, "contact", key), &Limits::default()).ok()?;
        let contact: SolvedContact = serde_json::from_slice(&text).ok()?;
        (contact.key == key).then_some(contact.films)
    }

    fn keep(&self, key: &str, films: &Films) {
        let contact = SolvedContact { key: key.into(), films: *films };
        write_whole(self.0, &cache_file(self.0, "contact", key), &contact);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rotordyn_bearing::contact::ehl::{self, Domain, Grid, Problem};
    use rotordyn_bearing::contact::{EllipticContact, Lubricant};
    use rotordyn_bearing::material::Material;
    use std::sync::atomic::{AtomicUsize, Ordering};

    fn steel() -> Material {
        Material { name: "steel".into(), young: 2.06e11, shear: 8e10, poisson: 0.3, density: 7850.0 }
    }

    fn oil() -> Lubricant {
        Lubricant { name: "oil".into(), viscosity: 0.04, pressure_viscosity: 2.2e-8, density: 870.0 }
    }

    #[test]
    fn no_convergence_writes_last_fields_and_reports_values() {
        let steel = steel();
        let problem = Problem {
            contact: EllipticContact::new(100.0, 100.0, [&steel, &steel]),
            lubricant: oil(),
            speed: 1.0,
            load: 20.0,
            grid: Grid { nx: 25, ny: 13, domain: Domain { inlet: 4.5, outlet: 1.5, side: 3.0 } },
        };
        let fields = ehl::solve(&problem, None).unwrap();
        let failure = EhlError::NoConvergence {
            load: problem.load,
            speed: problem.speed,
            residual: 0.125,
            iterations: 60,
            least_film: fields.minimum_film,
            last: Box::new(fields),
        };
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("new").join("last.csv");
        let message = film_error("A", "inner", &failure, &path).to_string();
        for part in ["bearing A, inner race", "20.0000 N", "1.0000 m/s", "1.250e-1", "60", "last.csv"] {
            assert!(message.contains(part), "{message} lacks {part}");
        }
        let text = std::fs::read_to_string(path).unwrap();
        assert!(text.starts_with("x_m,y_m,pressure_Pa,film_m\n") && text.lines().count() == 1 + 25 * 13);
    }

    #[test]
    fn cached_table_is_bit_exact_and_checked_by_key() {
        let folder = tempfile::tempdir().unwrap();
        let table = Table {
            key: "ehl table 1; test".into(),
            stiffness: 2.0e10 / 3.0,
            loads: vec![1.0, 10.0],
            speeds: vec![0.1],
            shift: vec![vec![1.0e-6 / 3.0, 2.0e-7]],
            central_film: vec![vec![3.0e-7, 0.1 + 0.2]],
            minimum_film: vec![vec![2.0e-7, 0.1 + 0.7]],
        };
        assert!(write(folder.path(), &table));
        assert_eq!(read(folder.path(), &table.key), Some(table.clone()));
        assert_eq!(read(folder.path(), "ehl table 1; other"), None);
        let renamed = cache_file(folder.path(), "film", "another");
        std::fs::rename(cache_file(folder.path(), "film", &table.key), &renamed).unwrap();
        assert_eq!(read(folder.path(), "another"), None);
        // Of the right key, but cut short by hand.
        let ragged = Table { minimum_film: vec![vec![2.0e-7]], ..table };
        assert!(write(folder.path(), &ragged));
        assert_eq!(read(folder.path(), &ragged.key), None);
    }

    /// A table that stops after some contacts finds them again: only the others are solved.
    #[test]
    fn interrupted_table_continues_where_it_was() {
        let steel = steel();
        let spec = TableSpec {
            contact: EllipticContact::new(200.0, 30.0, [&steel, &steel]),
            lubricant: oil(),
            loads: vec![5.0, 20.0],
            speeds: vec![2.0, 4.0],
            points: 2,
        };
        let folder = tempfile::tempdir().unwrap();
        let contacts = || {
            let files = std::fs::read_dir(folder.path()).unwrap().map(|f| f.unwrap().file_name());
            files.filter(|f| f.to_string_lossy().starts_with("contact-")).count()
        };
        // Stopped like a process that is killed, while the second contact is counted.
        let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
        let stopped = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| {
            one.install(|| spec.compute_with(&ContactFolder(folder.path()), |done, _| assert!(done < 2)))
        }));
        assert!(stopped.is_err());
        let kept = contacts();
        assert!((2..4).contains(&kept), "{kept}");
        struct Counted<'a>(ContactFolder<'a>, AtomicUsize);
        impl SolvedContacts for Counted<'_> {
            fn find(&self, key: &str) -> Option<Films> {
                self.0.find(key)
            }
            fn keep(&self, key: &str, films: &Films) {
                self.1.fetch_add(1, Ordering::Relaxed);
                self.0.keep(key, films);
            }
        }
        let rest = Counted(ContactFolder(folder.path()), AtomicUsize::new(0));
        let table = spec.compute_with(&rest, |_, _| ()).unwrap();
        assert_eq!(rest.1.load(Ordering::Relaxed), 4 - kept);
        assert_eq!(contacts(), 4);
        let direct = spec.compute(|_, _| ()).unwrap();
        for (found, wanted) in table.minimum_film.iter().flatten().zip(direct.minimum_film.iter().flatten()) {
            assert!((found / wanted - 1.0).abs() < 1e-4, "{found:e} {wanted:e}");
        }
        // A damaged file is solved again.
        for file in std::fs::read_dir(folder.path()).unwrap() {
            std::fs::write(file.unwrap().path(), "{").unwrap();
        }
        let again = Counted(ContactFolder(folder.path()), AtomicUsize::new(0));
        assert_eq!(spec.compute_with(&again, |_, _| ()).unwrap(), direct);
        assert_eq!(again.1.load(Ordering::Relaxed), 4);
    }
}
