//! How the running camera is set: sliders, and a button for each resolution.

use bevy_egui::egui;

use crate::app::inspector::tuner::{ROW, Tuner};
use crate::vision::{CameraSettings, Optics, Resolution};

/// Widths of a slider and of a number, in points.
pub const WIDTHS: (f32, f32) = (100.0, 58.0);
/// Width of a name, in points.
const NAME: f32 = 92.0;

/// One slider.
struct CameraKnob {
    name: &'static str,
    range: (f32, f32),
    decimals: usize,
    unit: &'static str,
    tip: &'static str,
    at: fn(&mut CameraSettings) -> &mut f32,
}

const KNOBS: [CameraKnob; 5] = [
    CameraKnob {
        name: "exposure",
        range: (0.1, 4.0),
        decimals: 2,
        unit: "",
        tip: "How long light falls on the sensor; longer is brighter, and blurs fast turns",
        at: |settings| &mut settings.exposure,
    },
    CameraKnob {
        name: "gain",
        range: (0.1, 4.0),
        decimals: 2,
        unit: "",
        tip: "By how much the signal is amplified, its noise with it",
        at: |settings| &mut settings.gain,
    },
    CameraKnob {
        name: "white, red",
        range: (0.25, 4.0),
        decimals: 2,
        unit: "",
        tip: "White balance: by how much red is amplified against green",
        at: |settings| &mut settings.white_balance.red,
    },
    CameraKnob {
        name: "white, blue",
        range: (0.25, 4.0),
        decimals: 2,
        unit: "",
        tip: "White balance: by how much blue is amplified against green",
        at: |settings| &mut settings.white_balance.blue,
    },
    CameraKnob {
        name: "frame rate",
        range: (1.0, 60.0),
        decimals: 0,
        unit: "Hz",
        tip: "Pictures a second",
        at: |settings| &mut settings.frame_hz,
    },
];

const RESOLUTIONS: [Resolution; 3] = [Resolution::Full, Resolution::Half, Resolution::Quarter];

/// Shows the settings with their controls; `file` has those to go back to.
pub fn show(ui: &mut egui::Ui, optics: &Optics, file: &CameraSettings, settings: &mut CameraSettings) {
    let mut filed = *file;
    ui.weak("The camera");
    for CameraKnob { name, range, decimals, unit, tip, at } in KNOBS {
        let tuner = Tuner { range, step: 0.0, decimals, unit, tip, widths: WIDTHS };
        slider(ui, name, &tuner, at(settings), *at(&mut filed));
    }
    ui.horizontal(|ui| {
        name_of(ui, "resolution");
        for resolution in RESOLUTIONS {
            let (width, height) = optics.picture_size(resolution);
            let button =
                ui.selectable_label(settings.resolution == resolution, format!("{width} × {height}"));
            if button.on_hover_text("Pixels of a picture").clicked() {
                settings.resolution = resolution;
            }
        }
    });
}

/// A row with a name, a slider, a number and the way back.
pub fn slider(ui: &mut egui::Ui, name: &str, tuner: &Tuner, value: &mut f32, filed: f32) {
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        name_of(ui, name);
        tuner.show(ui, value, filed);
    });
}

fn name_of(ui: &mut egui::Ui, name: &str) {
    let (rect, _) = ui.allocate_exact_size(egui::vec2(NAME, ROW), egui::Sense::hover());
    let font = egui::TextStyle::Body.resolve(ui.style());
    ui.painter().text(rect.left_center(), egui::Align2::LEFT_CENTER, name, font, ui.visuals().text_color());
}
