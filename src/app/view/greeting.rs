//! Waiting for robots that are processes of their own: the window shows which have not answered, and a person can give one up.

use bevy::prelude::*;
use bevy_egui::{EguiContexts, EguiPrimaryContextPass, egui};
use egui::{Color32, RichText};

use super::FrameSystems;
use super::actions::Action;
use super::bottom_bar::robot_text;
use super::calls::Trouble;
use super::colours;
use super::dialogues::{Open, show_in_the_middle};
use super::layout::{Edge, FreeArea, PanelSystems};
use super::state::Screen;
use super::style::panel_frame;
use crate::clock::Clock;
use crate::game::net::{self, Awaited, Greeting};
use crate::ids::RobotId;

/// The waiting itself, which needs no interface.
pub(super) fn waiting(app: &mut App) {
    app.init_resource::<Missing>().add_systems(Update, ask.in_set(FrameSystems::Input));
}

/// What a person sees of it.
pub(super) fn plugin(app: &mut App) {
    app.add_systems(
        EguiPrimaryContextPass,
        (show_silent.in_set(PanelSystems::Top), show_waiting.in_set(PanelSystems::Floating))
            .run_if(in_state(Screen::Match).and_then(|missing: Res<Missing>| !missing.robots.is_empty())),
    );
}

/// The robots in other processes that do not take part.
#[derive(Resource, Clone, Debug, Default, PartialEq, Eq)]
pub struct Missing {
    pub robots: Vec<Awaited>,
    /// Those that the person does not wait for any longer.
    pub given_up: Vec<RobotId>,
}

/// Whether the match has not begun, since robots are missing.
pub fn is_waiting(world: &World) -> bool {
    world.resource::<Clock>().tick == 0
        && world.get_resource::<Missing>().is_some_and(|missing| !missing.robots.is_empty())
}

/// Asks who is missing, without waiting for anybody. A frame in which nothing changes costs next to nothing.
pub fn ask(world: &mut World) {
    let given_up = world.resource_mut::<Missing>().bypass_change_detection().given_up.split_off(0);
    for robot in given_up {
        if let Err(error) = net::give_up(world, robot) {
            world.resource_mut::<Trouble>().0 = Some(error.to_string());
        }
    }
    let robots = match net::poll_greeting(world) {
        Greeting::Done => Vec::new(),
        Greeting::Awaiting(robots) => robots,
    };
    world.resource_mut::<Missing>().set_if_neq(Missing { robots, given_up: Vec::new() });
}

/// A robot with a button that gives it up; whether that was clicked.
fn show_robot(ui: &mut egui::Ui, missing: &Awaited, words: &str) -> bool {
    ui.horizontal_wrapped(|ui| {
        let told = format!("{} {words} {}", robot_text(missing.robot), missing.address);
        ui.label(RichText::new(told).color(Color32::WHITE)).on_hover_text(started_with(missing.robot));
        let tip = "Do not wait for it: its strategy plays it in this process";
        let clicked = ui.button("Play it here").on_hover_text(tip).clicked();
        if let Some(refusal) = &missing.refusal {
            ui.label(RichText::new(refusal).color(super::colours::egui(colours::PENALTY)));
        }
        clicked
    })
    .inner
}

/// How a person starts a robot.
fn started_with(robot: RobotId) -> String {
    format!("It is started with: touchline robot --team {} --number {}", robot.team, robot.number)
}

/// Before the match: in its middle.
fn show_waiting(
    mut contexts: EguiContexts,
    (open, clock): (Res<Open>, Res<Clock>),
    mut missing: ResMut<Missing>,
    mut actions: MessageWriter<Action>,
) -> Result {
    if clock.tick > 0 || open.question.is_some() || open.help {
        return Ok(());
    }
    let missing = missing.bypass_change_detection();
    let mut given_up = Vec::new();
    show_in_the_middle(contexts.ctx_mut()?, "Waiting", |ui| {
        ui.label(RichText::new("The match begins when these robots have answered").size(16.0));
        ui.add_space(6.0);
        for robot in &missing.robots {
            if show_robot(ui, robot, "at") {
                given_up.push(robot.robot);
            }
        }
        ui.add_space(6.0);
        if ui.button("Back to the menu").clicked() {
            actions.write(Action::Leave);
        }
    });
    missing.given_up.extend(given_up);
    Ok(())
}

/// During the match, which goes on without them: on a line.
fn show_silent(
    mut contexts: EguiContexts,
    (mut area, clock): (ResMut<FreeArea>, Res<Clock>),
    mut missing: ResMut<Missing>,
) -> Result {
    if clock.tick == 0 || area.room(Edge::Bottom) < 40.0 {
        return Ok(());
    }
    let missing = missing.bypass_change_detection();
    let panel = egui::Panel::top("silent robots")
        .resizable(false)
        .frame(panel_frame(colours::TROUBLE, egui::Margin::symmetric(12, 6)));
    let mut given_up = Vec::new();
    area.dock(contexts.ctx_mut()?, "silent robots", panel, |ui| {
        for robot in &missing.robots {
            if show_robot(ui, robot, "stands still: nobody answers at") {
                given_up.push(robot.robot);
            }
        }
    });
    missing.given_up.extend(given_up);
    Ok(())
}

#[cfg(test)]
mod tests {
    use std::net::{Ipv4Addr, UdpSocket};
    use std::path::Path;
    use std::time::Duration;

    use bevy::state::app::StatesPlugin;
    use bevy::time::TimeUpdateStrategy;

    use super::super::session::{Folder, Wanted, Wish};
    use super::*;
    use crate::data::AssetFolder;
    use crate::game::Choice;
    use crate::game::net::WirePlan;
    use crate::ids::Team;
    use crate::robot::Robot;

    const REMOTE: RobotId = RobotId::new(Team::Home, 1);

    /// Writes where robots and this match are: at free ports, but for the remote robot, whose socket never answers.
    fn write_addresses(file: &Path) -> UdpSocket {
        let free = || UdpSocket::bind((Ipv4Addr::LOCALHOST, 0)).expect("a free port");
        let silent = free();
        let mut lines = Vec::new();
        let mut held = Vec::new();
        let mut entry = |name: String, socket: &UdpSocket| {
            lines.push(format!("\"{name}\": \"{}\"", socket.local_addr().expect("an address")));
        };
        for team in Team::BOTH {
            for number in 0..4 {
                let socket = free();
                let is_remote = RobotId::new(team, number) == REMOTE;
                entry(format!("{team} {number}"), if is_remote { &silent } else { &socket });
                held.push(socket);
            }
        }
        let computer = free();
        entry(crate::comms::tcm::HOST.to_string(), &computer);
        std::fs::write(file, format!("{{{}}}", lines.join(", "))).expect("a file");
        silent
    }

    #[test]
    fn the_window_lives_while_a_robot_is_silent_and_plays_it_when_it_is_given_up() {
        let folder = tempfile::tempdir().expect("a folder");
        let addresses = folder.path().join("addresses.ron");
        let _silent = write_addresses(&addresses);
        let wires = WirePlan { udp: true, remote: vec![REMOTE], ..WirePlan::default() };
        let choice =
            Choice { wires: Box::new(wires), addresses: Some(addresses), seed: 3, ..Choice::default() };
        let mut app = App::new();
        app.add_plugins((MinimalPlugins, AssetPlugin::default(), StatesPlugin));
        app.init_asset::<Mesh>().init_asset::<ColorMaterial>();
        app.add_plugins((crate::simulation, super::super::played));
        app.insert_resource(TimeUpdateStrategy::ManualDuration(Duration::from_millis(50)));
        app.insert_resource(Folder(AssetFolder::new(concat!(env!("CARGO_MANIFEST_DIR"), "/assets"))));
        app.insert_resource(Wish(Some(Wanted::Match(choice))));
        app.finish();
        app.cleanup();
        for _ in 0..10 {
            app.update();
        }
        assert_eq!(app.world().resource::<Trouble>().0, None);
        let awaited = &app.world().resource::<Missing>().robots;
        assert_eq!(awaited.iter().map(|awaited| awaited.robot).collect::<Vec<_>>(), [REMOTE]);
        assert_eq!(app.world().resource::<Clock>().tick, 0, "the match waits");
        app.world_mut().resource_mut::<Missing>().given_up.push(REMOTE);
        for _ in 0..10 {
            app.update();
        }
        assert_eq!(*app.world().resource::<Missing>(), Missing::default());
        assert!(app.world().resource::<Clock>().tick > 0, "the match goes on");
        let mut robots = app.world_mut().query::<(&RobotId, &Robot)>();
        assert!(robots.iter(app.world()).all(|(_, robot)| !robot.remote));
    }
}
