//! Names of items below a group: a name with a slash, as `60/22`, is a path of groups.

use rotordyn_io::error::Error;
use rotordyn_io::hdf5::{LinkTarget, Reader};

/// Deepest name.
const DEEPEST: usize = 48;

/// Names of the groups below `group` that `is_item` accepts by their path; none if it is missing.
pub(crate) fn groups(
    reader: &dyn Reader,
    group: &str,
    is_item: &dyn Fn(&str) -> Result<bool, Error>,
) -> Result<Vec<String>, Error> {
    let mut out = Vec::new();
    if reader.contains(group)? {
        walk(reader, group, "", DEEPEST, &mut |path, name, is_group| {
            if is_group && is_item(path)? {
                out.push(name.into());
            }
            Ok(())
        })?;
    }
    Ok(out)
}

/// Names of the data sets below `group`.
pub(crate) fn sets(reader: &dyn Reader, group: &str) -> Result<Vec<String>, Error> {
    let mut out = Vec::new();
    walk(reader, group, "", DEEPEST, &mut |_, name, is_group| {
        if !is_group {
            out.push(name.into());
        }
        Ok(())
    })?;
    Ok(out)
}

/// Calls `visit` with path and name below the first group of every group and data set.
fn walk(
    reader: &dyn Reader,
    group: &str,
    name: &str,
    deeper: usize,
    visit: &mut dyn FnMut(&str, &str, bool) -> Result<(), Error>,
) -> Result<(), Error> {
    for link in reader.links(group)?.links {
        let path = format!("{group}/{}", link.name);
        let name = if name.is_empty() { link.name } else { format!("{name}/{}", link.name) };
        match link.target {
            LinkTarget::Group(_) => {
                visit(&path, &name, true)?;
                if deeper > 0 {
                    walk(reader, &path, &name, deeper - 1, visit)?;
                }
            }
            LinkTarget::DataSet(_) => visit(&path, &name, false)?,
            LinkTarget::Nothing(_) => {}
        }
    }
    Ok(())
}
