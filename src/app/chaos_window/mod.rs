//! ChaosManager as a window of its own process: it shows a robot of a match that is elsewhere, calibrates its camera, sends it
//! strategies and drives it, by messages over the TCM only (TeamChaos, section 1).

mod desk;
mod orders;
mod robot;
#[cfg(test)]
mod tests;

use std::time::Duration;

use bevy::prelude::*;
use bevy_egui::{EguiContexts, EguiPlugin, EguiPrimaryContextPass};

use crate::app::view::state::PanelSystems;
use crate::app::view::style;
use crate::app::window::{WindowEnd, default_plugins, ended};
use crate::data::AssetFolder;
use crate::game::net::chaos::{ChaosLink, Subscription};
use desk::ChaosDesk;
pub use desk::KnownMatch;
use robot::RobotElsewhere;

/// How often pictures and data are wanted, Hz.
const WANTED: Subscription = Subscription { images_hz: 10.0, data_hz: 5.0 };
/// How long an order is sent again and again.
const PATIENCE: Duration = Duration::from_secs(3);
/// A robot of which nothing is heard for so long is silent.
const SILENT: Duration = Duration::from_secs(1);

/// Opens the window on a link to a robot, and returns how it ended.
pub fn open_chaos_window(link: ChaosLink, assets: &AssetFolder, game: Option<KnownMatch>) -> WindowEnd {
    let desk = ChaosDesk::new(RobotElsewhere::new(link.robot()), assets.clone(), game);
    let mut app = App::new();
    app.add_plugins((default_plugins("Touchline: ChaosManager"), EguiPlugin::default(), style::plugin));
    app.insert_resource(ChaosManager { link, desk, trouble: None })
        .add_systems(Startup, |mut commands: Commands| {
            commands.spawn(Camera2d);
        })
        .add_systems(Update, talk)
        .add_systems(EguiPrimaryContextPass, show.after(PanelSystems::Clear));
    ended(app.run())
}

/// The link, and what is shown of the robot at its other end.
#[derive(Resource)]
struct ChaosManager {
    link: ChaosLink,
    desk: ChaosDesk,
    /// Why nothing can be sent.
    trouble: Option<String>,
}

fn talk(mut chaos: ResMut<ChaosManager>) {
    let ChaosManager { link, desk, trouble } = &mut *chaos;
    let images_hz = if desk.robot.is_blind { 0.0 } else { WANTED.images_hz };
    link.subscribe(Subscription { images_hz, ..WANTED });
    desk.robot.send(|instruction| link.order(instruction, PATIENCE));
    link.steer(desk.pilot());
    match link.poll(Duration::ZERO) {
        Ok(news) => {
            *trouble = None;
            news.into_iter().for_each(|news| desk.robot.hear(news));
        }
        Err(error) => *trouble = Some(error.to_string()),
    }
}

fn show(mut contexts: EguiContexts, time: Res<Time<Real>>, mut chaos: ResMut<ChaosManager>) -> Result {
    let ChaosManager { link, desk, trouble } = &mut *chaos;
    let silent = link.silent_for();
    let silence = trouble.clone().or((silent > SILENT).then(|| {
        let begun = if link.has_heard() { "is silent" } else { "has not answered" };
        format!("The match {begun} for {} s", silent.as_secs())
    }));
    desk.show(contexts.ctx_mut()?, (&link.figures(), silence.as_deref(), time.elapsed_secs_f64()));
    Ok(())
}
