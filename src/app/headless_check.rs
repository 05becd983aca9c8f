//! Whether this machine can show a window at all, asked before one is opened, so that its absence is one line and no panic.

/// What is missing for a window, in one line for people; `None` if there is a display and something to draw with.
pub fn missing_for_a_window() -> Option<String> {
    no_display().or_else(no_adapter)
}

#[cfg(target_os = "linux")]
fn no_display() -> Option<String> {
    if std::env::var_os("DISPLAY").is_none_or(|name| name.is_empty()) {
        return Some("there is no display (DISPLAY is not set)".into());
    }
    match x11rb::connect(None) {
        Ok((connection, _)) => {
            // An X server starts again when its last client leaves, and turns the next one away meanwhile.
            KEPT_OPEN.get_or_init(|| connection);
            None
        }
        Err(error) => {
            Some(format!("the display cannot be reached ({})", without_line_breaks(&error.to_string())))
        }
    }
}

#[cfg(target_os = "linux")]
static KEPT_OPEN: std::sync::OnceLock<x11rb::rust_connection::RustConnection> = std::sync::OnceLock::new();

#[cfg(not(target_os = "linux"))]
fn no_display() -> Option<String> {
    None
}

fn no_adapter() -> Option<String> {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle_from_env());
    let found = bevy::tasks::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions::default()));
    found
        .err()
        .map(|_| "there is no graphics adapter, not even one in software (Mesa's lavapipe is one)".into())
}

#[cfg(target_os = "linux")]
fn without_line_breaks(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}
