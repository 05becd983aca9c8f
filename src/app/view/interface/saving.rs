//! Writes the present moment as a scenario into the folder in which the program runs.

use std::path::PathBuf;

use bevy::prelude::*;
use ron::ser::PrettyConfig;

use crate::app::view::state::{Action, Announcement, FileError, FrameSystems, Session};
use crate::app::whole_file::write_whole;
use crate::clock::Clock;
use crate::data::ron_options;
use crate::game::DEFAULT_MATCH;
use crate::lab::replay::Recorded;
use crate::lab::scenario::CapturedMoment;

pub(super) fn plugin(app: &mut App) {
    app.init_resource::<ScenarioFolder>()
        .add_systems(Update, save.in_set(FrameSystems::Input).run_if(is_wanted));
}

/// Where moments are saved; the folder in which the program runs, if it is empty.
#[derive(Resource, Clone, Debug, Default)]
pub struct ScenarioFolder(pub PathBuf);

/// How long a saved scenario takes, s.
const SECONDS: f32 = 10.0;

fn is_wanted(mut actions: MessageReader<Action>) -> bool {
    actions.read().filter(|action| **action == Action::SaveScenario).count() > 0
}

fn save(world: &mut World) {
    match write(world) {
        Ok(path) => {
            let told = format!("Saved: touchline check {}", path.display());
            world.resource_mut::<Announcement>().tell(told);
        }
        Err(reason) => world.resource_mut::<FileError>().0 = Some(reason),
    }
}

fn write(world: &mut World) -> Result<PathBuf, String> {
    let Session { header, plan, scenario, .. } = world.resource::<Session>().clone();
    let plan = plan.ok_or("there is no match to save")?;
    let tick = world.resource::<Clock>().tick;
    let chosen = match header.as_ref().map(|header| &header.recorded) {
        Some(Recorded::Match(choice)) => choice.file.as_deref(),
        _ => None,
    };
    let moment = CapturedMoment {
        plan: &plan,
        game: scenario.as_ref().map_or(chosen.unwrap_or(DEFAULT_MATCH), |scenario| scenario.game.as_str()),
        pitch: scenario.as_ref().and_then(|scenario| scenario.pitch.as_deref()),
        script: scenario.as_ref().map_or(&[][..], |scenario| &scenario.scenario.script),
        seconds: SECONDS,
    };
    let file = moment.capture(world)?;
    let text =
        ron_options().to_string_pretty(&file, PrettyConfig::default()).map_err(|error| error.to_string())?;
    let name = format!("moment_{}_{tick}.ron", plan.seed);
    let path = world.resource::<ScenarioFolder>().0.join(name);
    write_whole(&path, text.as_bytes()).map_err(|error| format!("{}: {error}", path.display()))?;
    Ok(path)
}
