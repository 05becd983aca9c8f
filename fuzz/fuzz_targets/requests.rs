#![no_main]

#[path = "../checks/requests.rs"]
mod checks;
#[path = "../checks/shipped.rs"]
mod shipped;

libfuzzer_sys::fuzz_target!(|input: &[u8]| checks::requests(input));
