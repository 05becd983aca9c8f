//! How many frames the window draws in a second, if it need not wait for the screen.

use std::io::{self, Write};
use std::time::Duration;

use bevy::prelude::*;
use bevy::window::{PresentMode, PrimaryWindow};
use bevy::winit::{UpdateMode, WinitSettings};

pub(super) fn plugin(app: &mut App) {
    let always = UpdateMode::Continuous;
    app.insert_resource(WinitSettings { focused_mode: always, unfocused_mode: always })
        .add_systems(Startup, wait_for_no_screen)
        .add_systems(Last, count);
}

fn wait_for_no_screen(mut window: Single<&mut Window, With<PrimaryWindow>>) {
    window.present_mode = PresentMode::AutoNoVsync;
}

/// Frames and the time that they took.
#[derive(Clone, Copy, Debug, Default)]
struct Counted {
    frames: u32,
    time: Duration,
    longest: Duration,
}

fn count(time: Res<Time<Real>>, mut counted: Local<Counted>) {
    counted.frames += 1;
    counted.time += time.delta();
    counted.longest = counted.longest.max(time.delta());
    if counted.time >= Duration::from_secs(1) {
        let Counted { frames, time, longest } = std::mem::take(&mut *counted);
        let (rate, longest) = (f64::from(frames) / time.as_secs_f64(), 1000.0 * longest.as_secs_f64());
        // If nobody reads it, there is nobody to be told.
        let _ = writeln!(io::stderr(), "{rate:.1} frames a second, the longest {longest:.1} ms");
    }
}
