//! The camera's panel, across the window below the pitch: what the selected robot sees, what it makes of that, and how its camera
//! is calibrated. Everything that is changed is a request; what is saved is at once what the match uses.
//!
//! The panel itself ([`CalibrationPage`]) is drawn from plain data ([`CalibrationView`]), so that it serves robots elsewhere too.

mod camera_controls;
mod classes;
pub mod files;
#[cfg(test)]
pub mod hand;
mod history;
mod light_controls;
mod panel_state;
mod pictures;
#[cfg(test)]
pub mod samples;
mod seen;
#[cfg(test)]
mod tests;
mod thresholds;
mod view;
mod widget;
mod wishes;

use std::sync::Arc;

use bevy::ecs::system::SystemParam;
use bevy::prelude::*;
use bevy_egui::{EguiPrimaryContextPass, egui};

use super::low_panel::{LowDock, LowPanel};
use super::pending::Pending;
use crate::app::view::state::{Folder, Overlay, PanelSystems, Screen, Selected, Session, shows};
use crate::game::requests::{Request, Requests, RobotChange};
use crate::ids::RobotId;
use crate::robot::CalibratedCamera;
use crate::vision::{CameraCalibration, Gaze};
use crate::world::sense::{HallLight, ImageEyes, ImageMemory, LastLook, Lighting, PictureHall};
use history::CameraValues;
pub use view::{CalibrationView, CalibrationWish};
pub use widget::{CalibrationPage, CalibrationWidget};
use wishes::CameraWishes;

pub(super) fn plugin(app: &mut App) {
    app.init_resource::<CameraPanel>().add_systems(
        EguiPrimaryContextPass,
        dock.in_set(PanelSystems::Low).run_if(in_state(Screen::Match).and_then(shows(Overlay::Camera))),
    );
}

const PANEL: LowPanel = LowPanel {
    overlay: Overlay::Camera,
    id: "camera",
    heights: (220.0, 620.0),
    closes: "Close the camera's panel",
};

/// What the panel keeps from frame to frame.
#[derive(Resource, Default)]
struct CameraPanel(CalibrationWidget);

/// A robot that sees by pictures.
type WithCamera = (&'static RobotId, &'static CalibratedCamera, &'static ImageEyes, &'static ImageMemory);

/// The cameras that there are, and what they look at.
#[derive(SystemParam)]
struct Cameras<'w, 's> {
    selected: Res<'w, Selected>,
    light: Res<'w, HallLight>,
    hall: Res<'w, PictureHall>,
    robots: Query<'w, 's, WithCamera>,
}

/// The camera of the selected robot, with its last picture.
struct LookedThrough<'a> {
    robot: RobotId,
    camera: &'a CalibratedCamera,
    eyes: &'a ImageEyes,
    /// None before the first picture.
    last: Option<&'a LastLook>,
}

impl Cameras<'_, '_> {
    /// That of the selected robot.
    fn looked(&self) -> Option<LookedThrough<'_>> {
        let wanted = self.selected.0?;
        let (robot, camera, eyes, memory) = self.robots.iter().find(|(id, ..)| **id == wanted)?;
        Some(LookedThrough { robot: *robot, camera, eyes, last: memory.last() })
    }

    /// Why there is none.
    fn excuse(&self) -> String {
        match self.selected.0 {
            None => "Select a robot to see through its camera.".into(),
            Some(robot) => {
                format!("{robot} sees without pictures: the eyes of its sensing preset are not Images.")
            }
        }
    }
}

fn dock(
    mut dock: LowDock,
    cameras: Cameras,
    mut panel: ResMut<CameraPanel>,
    (folder, mut session): (Res<Folder>, ResMut<Session>),
    mut requests: ResMut<Requests>,
) -> Result {
    let Some(LookedThrough { robot, camera, eyes, last }) = cameras.looked() else {
        let title = |ui: &mut egui::Ui, _: &mut ()| {
            ui.label(egui::RichText::new("Camera").size(15.0).strong());
        };
        return dock.show(PANEL, &mut (), title, |ui, ()| {
            ui.weak(cameras.excuse());
        });
    };
    let calibration = asked_for(robot, camera, &requests);
    let file = filed(&session, robot);
    let truth: Vec<_> = eyes.truth().collect();
    let first = session.plan.as_ref().map(|plan| plan.light);
    let view = CalibrationView {
        whose: robot.to_string(),
        image: last.map(|_| eyes.image()),
        quality: None,
        gaze: last.map_or_else(Gaze::default, |last| last.gaze),
        known: cameras.hall.known(),
        truth: Some(&truth),
        light: first.map(|first| [asked_light(&cameras.light.light.mean, &requests), first]),
        calibration: &calibration,
        file: file.as_ref().map(|(name, file)| (name.as_str(), &**file)),
    };
    let names = || folder.0.names(crate::data::AssetKind::Camera);
    let mut page = CalibrationPage::new(&mut panel.0, view, &names);
    dock.show(PANEL, &mut page, |ui, page| page.show_toolbar(ui), |ui, page| page.show(ui))?;
    let asked = page.finish();
    let mut wishes = CameraWishes {
        robot,
        calibration: &calibration,
        assets: &folder.0,
        plan: session.bypass_change_detection().plan.as_mut(),
        requests: &mut requests,
    };
    let robots: Vec<RobotId> = cameras.robots.iter().map(|(id, ..)| *id).collect();
    for wish in asked {
        panel.0.panel.told = wishes.carry_out(wish, &robots).or(panel.0.panel.told.take());
    }
    Ok(())
}

/// The calibration in force, with what waits for the next tick.
fn asked_for(robot: RobotId, camera: &CalibratedCamera, requests: &Requests) -> CameraCalibration {
    let in_force = &camera.0;
    let settings = Pending::new(in_force.settings, requests, |request| match request {
        Request::Robot(id, RobotChange::SetCamera(settings)) if *id == robot => Some(*settings),
        _ => None,
    });
    let colours = Pending::new(in_force.colours.clone(), requests, |request| match request {
        Request::Robot(id, RobotChange::SetColours(colours)) if *id == robot => Some(colours.clone()),
        _ => None,
    });
    CameraValues { settings: settings.shown(), colours: colours.shown() }.put_into(in_force)
}

/// The light as it is meant to be, or is asked for.
fn asked_light(in_force: &Lighting, requests: &Requests) -> Lighting {
    let light = Pending::new(*in_force, requests, |request| match request {
        Request::Light(light) => Some(*light),
        _ => None,
    });
    light.shown()
}

/// What the file says of a robot's camera, and its name.
fn filed(session: &Session, robot: RobotId) -> Option<(String, Arc<CameraCalibration>)> {
    let senses = session.plan.as_ref()?.team(robot.team).senses(robot.number);
    Some((senses.sensing.eyes.calibration()?.to_owned(), senses.calibration.clone()?))
}
