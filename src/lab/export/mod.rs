//! A match for those who have no Touchline: a page that plays it, a log for robotics tools, pictures for papers.
//!
//! A match is played from its plan, and after each tick everything that is to be written takes note of the same moment.

pub mod drawing;
mod export_run;
pub mod figure;
mod forks;
mod gif;
mod log;
pub mod moment;
pub mod outlines;
pub mod page;
pub mod palette;
mod radio_watch;
mod raster;
mod svg;
mod trails;

pub use export_run::{ExportCounts, ExportError, ExportWishes, Exported, PageCounts, PageWish, export};
pub use forks::{ForkPlan, MOST_FORKS, PageForks};
