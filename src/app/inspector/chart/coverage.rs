//! Whose counts the chart shows: those of the running match, or those of a file.

use std::path::PathBuf;

use bevy::prelude::*;
use bevy_egui::egui;

use super::graph::ChartGraph;
use super::heat::Heat;
use crate::app::view::colours::{self, egui as paint};
use crate::app::view::state::{AfterTick, MatchBegun, Session};
use crate::ids::Team;
use crate::lab::coverage::{Coverage, MatchCoverage};

pub(super) fn plugin(app: &mut App) {
    app.init_resource::<ShownCoverage>().add_observer(begin).add_systems(AfterTick, count);
}

/// What is counted of the running match.
#[derive(Resource)]
struct RunningCoverage(MatchCoverage);

/// Whose counts the chart shows.
#[derive(Resource, Clone, Debug, PartialEq)]
pub struct ShownCoverage {
    source: CoverageSource,
    /// What a person has typed.
    path: String,
    /// What was read from a file.
    read: Option<Coverage>,
}

/// Where counts come from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum CoverageSource {
    #[default]
    Nowhere,
    Match,
    File,
}

impl Default for ShownCoverage {
    fn default() -> ShownCoverage {
        ShownCoverage { source: CoverageSource::Nowhere, path: "coverage.ron".into(), read: None }
    }
}

fn begin(_: On<MatchBegun>, mut commands: Commands) {
    commands.remove_resource::<RunningCoverage>();
}

/// Counts the tick that is just over, whether or not the chart is open: it may be opened later.
fn count(world: &mut World) {
    let running = world.remove_resource::<RunningCoverage>().or_else(|| {
        let plan = world.resource::<Session>().plan.as_ref()?;
        let names = plan.teams.each_ref().map(|team| team.names.strategy.clone());
        Some(RunningCoverage(MatchCoverage::new(world, names)))
    });
    if let Some(mut running) = running {
        running.0.observe(world);
        world.insert_resource(running);
    }
}

/// What the chart needs to show counts.
#[derive(bevy::ecs::system::SystemParam)]
pub struct Counts<'w> {
    running: Option<Res<'w, RunningCoverage>>,
    session: Res<'w, Session>,
    pub shown: ResMut<'w, ShownCoverage>,
}

impl Counts<'_> {
    /// The counts of a team's machine, if they are to be shown.
    pub fn heat(&self, team: Team, graph: &ChartGraph) -> Option<Heat> {
        let running;
        let coverage = match self.shown.source {
            CoverageSource::Nowhere => return None,
            CoverageSource::Match => {
                running = self.running.as_ref()?.0.sum();
                &running
            }
            CoverageSource::File => self.shown.read.as_ref()?,
        };
        let name = &self.session.plan.as_ref()?.team(team).names.strategy;
        Some(
            coverage
                .machine(name, &graph.name)
                .map_or_else(Heat::default, |counted| Heat::of(graph, counted)),
        )
    }
}

/// Shows the choice; what is wrong with a file that was to be read.
pub fn show_choice(ui: &mut egui::Ui, shown: &mut ShownCoverage) -> Option<String> {
    ui.weak("Counts");
    for (source, name, tip) in [
        (CoverageSource::Nowhere, "none", "Nothing is counted on the chart"),
        (CoverageSource::Match, "match", "How often each state and transition was reached in this match"),
        (CoverageSource::File, "file", "Those of a file that `touchline check --coverage FILE` wrote"),
    ] {
        if ui.selectable_label(shown.source == source, name).on_hover_text(tip).clicked() {
            shown.source = source;
        }
    }
    let mut fault = None;
    if shown.source == CoverageSource::File {
        let typed = ui.add(egui::TextEdit::singleline(&mut shown.path).desired_width(130.0));
        let entered = typed.lost_focus() && ui.input(|input| input.key_pressed(egui::Key::Enter));
        if ui.button("Read").clicked() || entered {
            match Coverage::read(&PathBuf::from(shown.path.trim())) {
                Ok(read) => shown.read = Some(read),
                Err(error) => fault = Some(error.to_string()),
            }
        }
    }
    if shown.source != CoverageSource::Nowhere {
        show_key(ui);
    }
    fault
}

/// What the colours mean.
fn show_key(ui: &mut egui::Ui) {
    const STEPS: u8 = 12;
    ui.weak("once");
    let (rect, _) = ui.allocate_exact_size(egui::vec2(48.0, 8.0), egui::Sense::hover());
    let step = rect.width() / f32::from(STEPS);
    for number in 0..STEPS {
        let left = rect.left() + step * f32::from(number);
        let part =
            egui::Rect::from_min_size(egui::pos2(left, rect.top()), egui::vec2(step + 0.5, rect.height()));
        let share = f32::from(number) / f32::from(STEPS - 1);
        ui.painter().rect_filled(part, 0.0, paint(colours::heat(share)));
    }
    ui.weak("most often, dashed: never");
}
