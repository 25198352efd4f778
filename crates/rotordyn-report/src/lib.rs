//! The results of a run as one page, `report.html`: self-contained, for any browser, without network.
//!
//! | module | content |
//! |---|---|
//! | [`page`] | the page from its parts |
//! | `overview`, `summary` | what matters first: warnings, drawing, ten lines |
//! | `model_table` | the model as it was understood |
//! | `stored` | the results file as a tree for the page's scripts |
//! | `history` | time histories, reduced to what a screen shows |
//! | `machine_view` | geometry that moves with the mode shapes |
//! | `captions` | what is seen in the drawn figures |
//! | `bearings` | the page of every ball bearing |
//! | `tree` | a computed result as a tree like that of the file |
//! | `arrays` | numbers packed into the page |
//! | `items` | names of items below a group of the file |
//! | `markup` | texts and tables in HTML |
//!
//! Everything is read from the results file, so that a page can be made of an older one as well; ball bearings without a
//! study in it are computed from its model. The scripts and styles
//! stand in `assets/report`.

mod arrays;
mod bearings;
mod captions;
mod history;
mod items;
mod machine_view;
mod markup;
mod model_table;
mod overview;
pub mod page;
mod stored;
mod summary;
mod tree;

pub use captions::caption;
pub use page::{Report, ReportError, write};
