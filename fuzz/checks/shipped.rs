//! The shipped assets, from the package itself and from the one of the fuzz targets.

use std::path::Path;

use touchline::data::AssetFolder;

/// The shipped assets.
pub fn shipped() -> AssetFolder {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let root = if here.join("assets").is_dir() { here.join("assets") } else { here.join("../assets") };
    AssetFolder::new(root)
}
