//! The team communication's panel, across the window below the pitch, as the ChaosManager shows it: what modules said and heard by
//! type, the queues in which their data wait, messages that arrived in part, and the referee box's view of the match.

mod counters;
mod fragments;
mod modules;
mod referee;

use bevy::ecs::system::SystemParam;
use bevy::prelude::*;
use bevy_egui::{EguiPrimaryContextPass, egui};
use counters::SummedCounters;
use egui::RichText;

use super::low_panel::{LowDock, LowPanel};
use crate::app::view::colours;
use crate::app::view::state::{Overlay, PanelSystems, Screen, Selected, shows};
use crate::clock::Clock;
use crate::comms::tcm::{DataType, Registry, Tcm, TcmClient};
use crate::ids::{RobotId, Team};
use crate::robot::Orders;
use crate::world::gamecontroller::BoxNews;
use crate::world::referee::MatchState;

pub(super) fn plugin(app: &mut App) {
    app.init_resource::<CommunicationView>().add_systems(
        EguiPrimaryContextPass,
        dock.in_set(PanelSystems::Low)
            .run_if(in_state(Screen::Match).and_then(shows(Overlay::Communication))),
    );
}

/// What of the team communication is looked at.
#[derive(Resource, Clone, Copy, Debug, Default, PartialEq, Eq)]
struct CommunicationView {
    page: CommunicationPage,
    whose: Whose,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum CommunicationPage {
    #[default]
    Modules,
    Fragments,
    Referee,
}

impl CommunicationPage {
    const ALL: [(CommunicationPage, &'static str, &'static str); 3] = [
        (CommunicationPage::Modules, "Modules", "What modules said and heard of each type, and their queues"),
        (CommunicationPage::Fragments, "Fragments", "Messages that the selected robot has received in part"),
        (CommunicationPage::Referee, "Referee", "What the GameController says, and what each robot was told"),
    ];
}

/// Whose counters are shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Whose {
    /// The selected robot's, and all while there is none.
    #[default]
    Selected,
    Team(Team),
    All,
}

impl Whose {
    /// Whether a robot's counters count.
    fn includes(self, robot: RobotId, selected: Option<RobotId>) -> bool {
        match self {
            Whose::Selected => selected.is_none_or(|selected| selected == robot),
            Whose::Team(team) => robot.team == team,
            Whose::All => true,
        }
    }
}

/// What there is to see of the team communication.
#[derive(SystemParam)]
struct CommunicationData<'w, 's> {
    clock: Res<'w, Clock>,
    state: Res<'w, MatchState>,
    registry: Res<'w, Registry>,
    selected: Res<'w, Selected>,
    news: Option<Res<'w, BoxNews>>,
    robots: Query<'w, 's, (&'static RobotId, &'static Tcm, &'static TcmClient, &'static Orders)>,
}

impl CommunicationData<'_, '_> {
    fn sums(&self, whose: Whose) -> SummedCounters {
        let mut sums = SummedCounters::default();
        sums.name(self.registry.types().map(|known| (known.module, known.number)));
        for (id, tcm, client, _) in self.robots.iter() {
            if whose.includes(*id, self.selected.0) {
                sums.add(&tcm.counters);
                sums.add_queues(client.rows());
            }
        }
        sums
    }

    fn orders(&self) -> Vec<(RobotId, Orders)> {
        let mut orders: Vec<_> = self.robots.iter().map(|(id, .., orders)| (*id, *orders)).collect();
        orders.sort_unstable_by_key(|(id, _)| *id);
        orders
    }

    fn name_of(&self, data_type: DataType) -> String {
        let known = self.registry.types().find(|known| known.number == data_type);
        known.map_or_else(|| data_type.to_string(), |known| known.name.to_owned())
    }
}

const PANEL: LowPanel = LowPanel {
    overlay: Overlay::Communication,
    id: "communication",
    heights: (150.0, 420.0),
    closes: "Close the team communication's panel",
};
/// The least height of a page, in points; the panel scrolls where it is lower.
const PAGE: f32 = 100.0;

fn dock(mut dock: LowDock, heard: CommunicationData, mut view: ResMut<CommunicationView>) -> Result {
    let page = |ui: &mut egui::Ui, view: &mut CommunicationView| {
        let page = egui::vec2(ui.available_width(), ui.available_height().max(PAGE));
        ui.allocate_ui(page, |ui| {
            let scroll = egui::ScrollArea::horizontal().auto_shrink(false);
            scroll.show(ui, |ui| show_page(ui, view.page, view.whose, &heard));
        });
    };
    dock.show(PANEL, &mut *view, |ui, view| show_toolbar(ui, &heard, view), page)
}

fn show_page(ui: &mut egui::Ui, page: CommunicationPage, whose: Whose, heard: &CommunicationData) {
    let names = |data_type: DataType| heard.name_of(data_type);
    match page {
        CommunicationPage::Modules => modules::show(ui, &heard.sums(whose), &names),
        CommunicationPage::Fragments => {
            let looked_at = heard.robots.iter().find(|(id, ..)| Some(**id) == heard.selected.0);
            let assembly = looked_at.map(|(id, tcm, ..)| (*id, &tcm.assembly));
            fragments::show(ui, assembly, &heard.clock, &names);
        }
        CommunicationPage::Referee => {
            referee::show(ui, heard.news.as_deref(), &heard.state, &heard.clock, &heard.orders());
        }
    }
}

/// Shows the pages and whose counters are meant.
fn show_toolbar(ui: &mut egui::Ui, heard: &CommunicationData, view: &mut CommunicationView) {
    ui.label(RichText::new("Team communication").size(15.0).strong());
    ui.separator();
    for (page, name, tip) in CommunicationPage::ALL {
        if ui.selectable_label(view.page == page, name).on_hover_text(tip).clicked() {
            view.page = page;
        }
    }
    if view.page == CommunicationPage::Modules {
        ui.separator();
        show_whose(ui, heard, view);
    }
}

fn show_whose(ui: &mut egui::Ui, heard: &CommunicationData, view: &mut CommunicationView) {
    let selected = heard.selected.0;
    ui.weak("Counters of");
    let own = selected.map_or("all, none selected".into(), |robot| robot.to_string());
    for (whose, name, tip) in [
        (Whose::Selected, own.as_str(), "The selected robot; all robots together while none is selected"),
        (Whose::Team(Team::Home), "home", "All robots of home together"),
        (Whose::Team(Team::Away), "away", "All robots of away together"),
        (Whose::All, "all robots", "The robots of both teams together"),
    ] {
        let team = match whose {
            Whose::Selected => selected.map(|robot| robot.team),
            Whose::Team(team) => Some(team),
            Whose::All => None,
        };
        let text = match team {
            Some(team) => RichText::new(name).color(colours::egui(colours::team_text(team))),
            None => RichText::new(name),
        };
        if ui.selectable_label(view.whose == whose, text).on_hover_text(tip).clicked() {
            view.whose = whose;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counters_are_of_one_robot_a_team_or_all() {
        let (mine, mate, other) =
            (RobotId::new(Team::Home, 1), RobotId::new(Team::Home, 2), RobotId::new(Team::Away, 1));
        let included =
            |whose: Whose, selected| [mine, mate, other].map(|robot| whose.includes(robot, selected));
        assert_eq!(included(Whose::Selected, Some(mine)), [true, false, false]);
        assert_eq!(included(Whose::Selected, None), [true; 3]);
        assert_eq!(included(Whose::Team(Team::Home), Some(other)), [true, true, false]);
        assert_eq!(included(Whose::All, Some(mine)), [true; 3]);
    }
}
