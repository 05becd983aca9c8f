//! Work that may break the program.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Does the work.
///
/// # Errors
/// If it breaks the program: what the panic says.
pub(super) fn unbroken<T>(work: impl FnOnce() -> T) -> Result<T, String> {
    catch_unwind(AssertUnwindSafe(work)).map_err(|cause| message(&*cause))
}

/// What a panic says.
fn message(cause: &(dyn Any + Send)) -> String {
    let text = cause.downcast_ref::<&str>().map(|text| (*text).to_owned());
    text.or_else(|| cause.downcast_ref::<String>().cloned()).unwrap_or_else(|| "the match broke off".into())
}
