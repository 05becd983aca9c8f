"""Reads what `touchline export` writes by other programs: the log by the package mcap, the page by headless Chromium.

    python3 read_back.py TOUCHLINE [--shots FOLDER]

plays and records a short match, exports it, and compares: the log with its schemas and with the report of the match, the page with the
log. It ends with exit code 1 and says what differs.
"""

import argparse
import collections
import json
import pathlib
import random
import subprocess
import sys
import tempfile

import jsonschema
from mcap.reader import make_reader
from selenium import webdriver
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.keys import Keys

MATCH = "--seed 14 --minutes 1 --home rmit --radio bursty".split()
DT = 1 / 60


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("--shots", type=pathlib.Path, help="keep pictures of the page in this folder")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        report, counts = record_and_export(options.program, folder)
        log = read_log(folder / "match.mcap")
        tests = [(check_log, (log, report, counts))]
        browser = open_browser(folder)
        try:
            browser.get((folder / "match.html").as_uri())
            browser.execute_async_script(WAIT_FOR_PAGE)
            tests += [(check, (browser, log, report, counts, options.shots)) for check in PAGE_CHECKS]
            failed = [name for name in (run(check, arguments) for check, arguments in tests) if name]
        finally:
            browser.quit()
    print(f"{len(tests) - len(failed)} passed, {len(failed)} failed")
    sys.exit(1 if failed else 0)


def run(check, arguments):
    """The name of the check if it fails."""
    name = check.__name__.replace("_", " ")
    try:
        check(*arguments)
    except AssertionError as error:
        print(f"FAILED {name}: {error}")
        return name
    print(f"ok     {name}")
    return None


def record_and_export(program, folder):
    def touchline(*arguments):
        done = subprocess.run([program, *arguments], capture_output=True, text=True, check=False)
        if done.returncode != 0:
            sys.exit(f"touchline {' '.join(arguments)}: exit {done.returncode}: {done.stderr}")
        return json.loads(done.stdout)

    report = touchline("run", *MATCH, "--json", "--record", str(folder / "match.replay"))
    files = [f"--html={folder}/match.html", f"--mcap={folder}/match.mcap", "--forks=2"]
    counts = touchline("export", str(folder / "match.replay"), *files, "--json")
    return report, counts


def read_log(path):
    """The messages of each topic: time in ns and content; and the schemas."""
    topics, schemas = collections.defaultdict(list), {}
    with open(path, "rb") as file:
        for schema, channel, message in make_reader(file, validate_crcs=True).iter_messages():
            topics[channel.topic].append((message.log_time, json.loads(message.data)))
            schemas[channel.topic] = json.loads(schema.data)
    return topics, schemas


def check_log(log, report, counts):
    topics, schemas = log
    found = {topic: len(messages) for topic, messages in topics.items()}
    told = {topic: count for topic, count in counts["log"].items() if count}
    assert found == told, f"counts {found}, told {told}"
    assert counts["digest"] == report["digest"], "another match was exported"
    for topic, messages in topics.items():
        check = jsonschema.Draft202012Validator(schemas[topic])
        for _, message in messages[:: max(1, len(messages) // 200)]:
            check.validate(message)
            strangers = set(message) - set(schemas[topic]["properties"])
            assert not strangers, f"{topic}: {strangers} are not in the schema"
        times = [time for time, _ in messages]
        assert times == sorted(times), f"{topic} is not in order"
        for time, message in messages[:: max(1, len(messages) // 200)]:
            if "tick" in message:
                assert abs(time / 1e9 - message["tick"] * DT) < 1e-3, f"{topic}: {time} ns at tick {message['tick']}"
    packets = [message for _, message in topics["/messages"]]
    for number, team in enumerate(["home", "away"]):
        sent = [packet for packet in packets if packet["from"].startswith(team)]
        lost = [packet for packet in sent if "lost" in packet]
        bytes_sent = sum(packet["bytes"] for packet in sent)
        told = report["messages"][number]
        assert (len(sent), len(lost), bytes_sent) == (told["sent"], told["lost"], told["bytes"]), f"{team}: {told}"
    goals = [message for _, message in topics["/events"] if message["text"].startswith("Goal for")]
    assert len(goals) == sum(report["score"]), f"{len(goals)} goals, score {report['score']}"
    assert len(topics["/poses"]) == report["ticks"] // 3 + 1, f"{len(topics['/poses'])} poses"


WAIT_FOR_PAGE = """
const done = arguments[arguments.length - 1];
const look = () => (window.touchline || !document.getElementById("trouble").hidden ? done() : setTimeout(look, 20));
look();
"""


def open_browser(folder):
    options = webdriver.ChromeOptions()
    options.binary_location = "/usr/bin/chromium"
    flags = ["--headless=new", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--window-size=1280,900"]
    quiet = ["--disable-background-networking", "--disable-component-update", "--disable-sync", f"--user-data-dir={folder}/browser"]
    for flag in flags + quiet:
        options.add_argument(flag)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    browser = webdriver.Chrome(options=options, service=webdriver.ChromeService("/usr/bin/chromedriver"))
    browser.set_script_timeout(60)
    return browser


def now(browser):
    return browser.execute_script("return touchline.now")


def press(browser, *keys):
    ActionChains(browser).send_keys(*keys).perform()


def check_page_shows_the_match_and_asks_for_nothing(browser, log, report, counts, shots):
    trouble = browser.execute_script("return document.getElementById('trouble').textContent")
    assert not trouble, trouble
    asked = browser.execute_script("return performance.getEntriesByType('resource').map((entry) => entry.name)")
    assert asked == [], asked
    match = browser.execute_script("const m = touchline.match; return [m.ticks, m.digest, m.messages.length, m.forks.length]")
    page = counts["page"]
    assert match == [report["ticks"], report["digest"], page["messages"], page["forks"]], match
    told = [message for _, message in log[0]["/messages"] if message["kind"] not in ("position", "ball report", "values")]
    assert len(told) == page["messages"], f"{len(told)} messages in the log, {page['messages']} on the page"


def check_positions_at_100_random_ticks_are_those_of_the_log(browser, log, report, counts, shots):
    exact = browser.execute_script("return touchline.match.exact")
    place, heading = exact["place"][1] + 1e-6, exact["heading"][1] + 1e-6
    assert place <= 0.0051 and heading <= 0.0176, exact
    poses = [message for _, message in log[0]["/poses"]]
    for truth in random.Random(7).sample(poses, 100):
        shown = browser.execute_script("return touchline.match.at(arguments[0])", truth["tick"])
        off = [abs(shown["ball"][axis] - truth["ball"][axis]) for axis in "xy"]
        for robot, body in zip(truth["robots"], shown["robots"], strict=True):
            assert robot["robot"] == body["name"]
            off += [abs(body[axis] - robot[axis]) for axis in "xy"]
            for angle in ["heading", "trailer"]:
                turned = (body[angle] - robot[angle] + 3.14159265) % 6.2831853 - 3.14159265
                assert abs(turned) <= heading, f"tick {truth['tick']}: {robot['robot']} {angle} is off by {turned}"
        assert max(off) <= place, f"tick {truth['tick']}: off by {max(off)} m"


def check_the_keyboard_moves_time(browser, log, report, counts, shots):
    ticks = report["ticks"]
    press(browser, Keys.HOME)
    assert now(browser) == 0
    press(browser, Keys.ARROW_RIGHT, Keys.ARROW_RIGHT)
    assert abs(now(browser) - 120) < 1e-3, now(browser)
    press(browser, ".")
    assert now(browser) == 121, now(browser)
    press(browser, ",", ",")
    assert now(browser) == 119, now(browser)
    press(browser, Keys.ARROW_LEFT)
    assert abs(now(browser) - 59) < 1e-3, now(browser)
    press(browser, " ")
    browser.execute_async_script("const done = arguments[0]; const from = touchline.now; const look = () => (touchline.now > from + 5 ? done() : requestAnimationFrame(look)); look();")
    press(browser, " ")
    assert not browser.execute_script("return touchline.playing")
    press(browser, Keys.END)
    assert now(browser) == ticks, now(browser)
    press(browser, Keys.HOME, Keys.ARROW_DOWN)
    first = browser.execute_script("return touchline.match.events.find((event) => event.kind !== 'role' && event.tick > 0).tick")
    assert now(browser) == first, (now(browser), first)


def check_the_keyboard_switches_what_is_shown(browser, log, report, counts, shots):
    press(browser, Keys.HOME, Keys.ARROW_RIGHT)
    pixels = "return document.getElementById(arguments[0]).toDataURL()"
    settle = "const done = arguments[0]; requestAnimationFrame(() => requestAnimationFrame(done));"
    for key, what in [("b", "pitch"), ("l", "pitch"), ("s", "chart"), ("m", "chart"), ("]", "chart"), ("d", "chart")]:
        browser.execute_async_script(settle)
        before = browser.execute_script(pixels, what)
        press(browser, key)
        browser.execute_async_script(settle)
        assert browser.execute_script(pixels, what) != before, f"{key} changes nothing"
    if counts["page"]["forks"]:
        browser.execute_script("touchline.goTo(touchline.match.forks[0].until)")
        browser.execute_async_script(settle)
        before = browser.execute_script(pixels, "pitch")
        press(browser, "1")
        browser.execute_async_script(settle)
        assert browser.execute_script(pixels, "pitch") != before, "the other future is not to be seen"
    press(browser, "?")
    assert browser.execute_script("return document.getElementById('keys').open")
    press(browser, Keys.ESCAPE)
    assert not browser.execute_script("return document.getElementById('keys').open")


def check_a_click_on_the_time_line_goes_there(browser, log, report, counts, shots):
    line = browser.find_element("id", "line")
    ActionChains(browser).move_to_element(line).click().perform()
    middle = report["ticks"] / 2
    near = browser.execute_script("return touchline.match.events.some((event) => event.tick === touchline.now)")
    assert near or abs(now(browser) - middle) < 0.01 * report["ticks"], now(browser)


def check_a_state_and_its_reason_are_those_of_the_log(browser, log, report, counts, shots):
    states = [message for _, message in log[0]["/states"] if "because" in message]
    assert states, "no robot took a transition"
    for state in random.Random(8).sample(states, min(30, len(states))):
        shown = browser.execute_script(
            "const robot = touchline.match.robots.find((robot) => robot.name === arguments[0]); return robot.state(arguments[1])",
            state["robot"], state["tick"])
        wanted = (state["tick"], state["acting_as"], state["state"], state["because"])
        assert (shown["since"], shown["acting"], shown["state"], shown["because"]) == wanted, f"{shown} for {state}"


def check_beliefs_are_those_of_the_log(browser, log, report, counts, shots):
    exact = browser.execute_script("return touchline.match.exact.believed_place[1]") + 1e-6
    beliefs = [message for _, message in log[0]["/beliefs"]]
    for belief in random.Random(9).sample(beliefs, 60):
        shown = browser.execute_script(
            "const robot = touchline.match.robots.find((robot) => robot.name === arguments[0]);"
            "return [robot.believed.at(arguments[1]), robot.believedBall.at(arguments[1])]",
            belief["robot"], belief["tick"])
        for place, known in zip(shown, [belief.get("pose"), belief.get("ball")]):
            assert (place is None) == (known is None), f"{belief}: {place}"
            if known:
                assert abs(place[0] - known["x"]) <= exact and abs(place[1] - known["y"]) <= exact, f"{belief}: {place}"


def check_the_console_is_silent(browser, log, report, counts, shots):
    if shots:
        take_pictures(browser, shots)
    said = browser.get_log("browser")
    assert said == [], said


def take_pictures(browser, shots):
    shots.mkdir(parents=True, exist_ok=True)
    swap = "const m = touchline.match.messages.find((m) => m.attempt > 0); touchline.setPlaying(false); touchline.goTo(m ? m.arrives : 600);"
    for theme in ["dark", "light"]:
        browser.execute_script(f"touchline.setTheme('{theme}'); touchline.showChart('messages'); {swap}")
        browser.execute_async_script("const done = arguments[0]; requestAnimationFrame(() => requestAnimationFrame(done));")
        browser.save_screenshot(str(shots / f"page_{theme}.png"))


PAGE_CHECKS = [value for name, value in list(globals().items()) if name.startswith("check_") and name != "check_log"]

if __name__ == "__main__":
    main()
