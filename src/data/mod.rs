//! Reading the RON files that describe strategies, pitches, robots and matches.
//!
//! An [`AssetFolder`] says where the files are, a [`Source`] holds the text of one and parses it, and every failure is
//! a [`DataError`] that names the file, the line, the column and the [`Field`]. What a file may say is not checked
//! here: the module that owns the type validates it and reports through [`Source::error_at`].

mod bounds;
mod error;
mod fault;
mod field;
mod field_names;
mod folder;
mod kind;
mod listing;
mod locate;
mod numbers;
mod scan;
mod source;
mod texts;
mod twice;
mod words;

pub use bounds::{Bound, check_all};
pub use error::{DataError, in_one_line, no_such};
pub use fault::{Fault, Validate, check_count, ensure};
pub use field::{Field, Segment};
pub use field_names::field_names;
pub use folder::{AssetFolder, is_path};
pub use kind::AssetKind;
pub use locate::locate;
pub use numbers::{NumberToken, numbers, with_number};
pub use source::{Source, TopLevel, contents, ron_options};
pub use texts::{AssetTexts, ReadTexts};
