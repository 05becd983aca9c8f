//! Experiments: a design with factors, every match of it as a row of figures, on all cores.
//!
//! An [`ExperimentFile`] is what is written in `assets/experiments`; an [`ExperimentPlan`] plays it, and each match becomes an
//! [`ExperimentRow`] with the value of every [`Metric`].

mod claim;
mod effect;
mod figure_words;
mod file;
mod metric;
mod pairing;
mod parquet;
mod plan;
mod row;
mod run;
mod summary;
mod table;
mod treatment;
mod until;

pub use claim::{ClaimVerdict, JudgedClaim};
pub(in crate::lab) use claim::{telling, verdict};
pub(in crate::lab) use effect::{check_effects, read_treatment};
pub use figure_words::{MeanWithInterval, probability};
pub use file::{
    ClaimedDifference, DesignChange, ExperimentFile, Factor, FactorLevels, NamedLevel, SeedBlocks,
    StatedClaim, UntilRule,
};
pub(in crate::lab) use file::{PlacedChange, check_changes, check_is_a_teams, placed};
pub use metric::{MatchFigures, Metric};
pub use pairing::PairedRows;
pub use parquet::write_parquet;
pub use plan::ExperimentPlan;
pub use row::{ExperimentRow, MatchResult, RowKey};
pub(in crate::lab) use row::{VERSION, check_version};
pub use summary::{CONFIDENCE, ExperimentSummary, FigureSummary, TreatmentSummary};
pub use table::{TableWriter, read_csv, write_csv};
pub(in crate::lab) use treatment::{TreatmentPlan, number_at};
