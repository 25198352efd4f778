"""Opens report pages in headless Chromium and checks what a reader would.

    check_reports.py CHROMIUM PAGE RESULTS [PAGE RESULTS ...] [--shots FOLDER]
    check_reports.py --only-open CHROMIUM PAGE [PAGE ...]

Prints a line for every page and every fault; exit code 1 with faults.
"""

import math
import sys
from pathlib import Path

import h5py
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import sync_playwright

FLAGS = ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
PRINTED_WIDTH = 688  # 182 mm, A4 between its margins
HOVER_DIGITS = 5e-5  # half a unit of the fifth digit


class Faults:
    def __init__(self, page):
        self.page = page
        self.list = []

    def unless(self, holds, words):
        if not holds:
            self.list.append(words)


def open_page(browser, path, faults, **options):
    page = browser.new_page(**options)
    page.on("console", lambda message: faults.unless(message.type != "error", f"console: {message.text}"))
    page.on("pageerror", lambda error: faults.unless(False, f"script: {error}"))
    local = ("file:", "data:", "blob:")
    page.on("dialog", lambda dialog: (faults.unless(False, f"dialog: {dialog.message[:60]}"), dialog.dismiss()))
    page.on("request", lambda request: faults.unless(request.url.startswith(local), f"request: {request.url[:100]}"))
    page.goto(path.as_uri())
    page.wait_for_selector("body[data-ready]", timeout=120_000)
    return page


def draw_all(page):
    page.evaluate("charts.forEach((made) => made.draw())")
    page.wait_for_function("charts.every((made) => made.plot.data !== undefined)", timeout=120_000)


def check_curves(page, faults):
    counts = page.evaluate("charts.map((made) => [made.node.textContent.slice(0, 40), made.plot.data.filter((t) => t.x && t.x.length > 0).length])")
    for words, curves in counts:
        faults.unless(curves > 0, f"no curve in: {words}")
    faults.unless(page.locator("p.failed").count() == 0, "a section failed")
    return len(counts)


def hover(page, chart, curve, point):
    """The text of the label at a point of a curve."""
    page.evaluate(
        """([chart, curve, point]) => {
            const plot = charts[chart].plot;
            const axes = plot.data[curve].yaxis === "y2" ? "xy2" : "xy";
            Plotly.Fx.hover(plot, [{ curveNumber: curve, pointNumber: point }], axes);
        }""",
        [chart, curve, point],
    )
    label = page.locator(".hovertext tspan, .hovertext text:not(:has(tspan))")
    label.first.wait_for(state="attached", timeout=5_000)
    return " ".join(label.all_text_contents())


def chart_index(page, words):
    return page.evaluate("(words) => charts.findIndex((made) => made.node.textContent.includes(words))", words)


def numbers_in(text):
    found = []
    for word in text.replace("−", "-").replace("<b>", " ").replace(":", " ").split():
        try:
            found.append(float(word))
        except ValueError:
            pass
    return found


def says(text, value):
    return any(math.isclose(number, value, rel_tol=HOVER_DIGITS, abs_tol=1e-300) for number in numbers_in(text))


def check_hovers(page, results, faults):
    """A point of the Campbell diagram, of an FRF and of the unbalance response against the file."""
    checked = 0
    if "campbell/frequency" in results:
        frequency = results["campbell/frequency"][()]
        chart = chart_index(page, "Campbell diagram:")
        branch, speed = 0, frequency.shape[1] // 2
        text = hover(page, chart, 2 * branch, speed)
        faults.unless(says(text, frequency[branch, speed]), f"Campbell hover says {text!r}, file {frequency[branch, speed]}")
        checked += 1
    if "frf/response" in results:
        response = results["frf/response"][0, 0]
        point = len(response) // 3
        text = hover(page, chart_index(page, "Frequency response functions of"), 0, point)
        faults.unless(says(text, abs(response[point])), f"FRF hover says {text!r}, file {abs(response[point])}")
        checked += 1
    if "unbalance/channels" in results:
        name = sorted(results["unbalance/channels"])[0]
        values = results[f"unbalance/channels/{name}"]
        unit = values.attrs["unit"]
        factor = {"m": 1e6, "m/s": 1e3}.get(unit if isinstance(unit, str) else unit.decode(), 1.0)
        point = len(values) // 2
        text = hover(page, chart_index(page, "Response to unbalance:"), 0, point)
        expected = factor * abs(values[point])
        faults.unless(says(text, expected), f"unbalance hover says {text!r}, file {expected}")
        checked += 1
    return checked


def check_bearings(page, results, faults):
    """Every ball bearing has its section; the load of its most loaded ball is that of the file."""
    sections = page.evaluate("[...document.querySelectorAll('section[id^=bearing-] h2')].map((e) => e.textContent)")
    stored = []
    if "bearings" in results:
        results["bearings"].visititems(lambda path, group: stored.append(path) if "load_source" in group.attrs else None)
    for name in stored:
        faults.unless(f"Bearing {name}" in sections, f"no section of bearing {name} among {sections}")
    for k, title in enumerate(sections):
        if page.locator(f"#bearing-{k}").inner_text().find("Not shown:") >= 0:
            continue
        faults.unless(page.locator(f"#bearing-{k} figure.table").count() >= 6, f"{title}: too few tables")
        name = title.removeprefix("Bearing ")
        if name not in stored:
            continue
        loads = results[f"bearings/{name}/operating/balls/outer/load"][()]
        position = results[f"bearings/{name}/operating/balls/position"][()]
        rows = results[f"bearings/{name}/operating/balls/row"][()]
        ball = int(loads.argmax())
        inside = [j for j in range(len(loads)) if rows[j] == rows[ball]]
        chart = page.evaluate(
            "(k) => charts.findIndex((made) => made.node.closest('section')?.id === `bearing-${k}` && made.node.textContent.includes('Load of every ball'))", k
        )
        # Two circles, bars of both races, then the balls of every row.
        text = hover(page, chart, 5 * int(rows[ball]) + 4, inside.index(ball))
        faults.unless(says(text, loads[ball]), f"{title}: hover says {text!r}, file {loads[ball]} N at {math.degrees(position[ball])} deg")
    return len(sections)


def check_shapes(page, results, faults):
    """Every mode moves: a picture of it differs from one a moment later."""
    if page.locator("canvas").count() == 0:
        return 0
    faults.unless(page.locator(".viewer p").count() == 0, "no WebGL")
    canvas = page.locator("canvas")
    canvas.scroll_into_view_if_needed()
    lists = page.locator("#campbell select, #shapes select")
    choice = page.locator("#campbell select").first if "campbell/shapes" in results else lists.last
    modes = choice.locator("option").count()
    for mode in range(modes):
        choice.select_option(index=mode)
        canvas.scroll_into_view_if_needed()
        before = page.evaluate("document.querySelector('canvas').toDataURL()")
        page.wait_for_function("(before) => document.querySelector('canvas').toDataURL() !== before", arg=before, timeout=20_000)
        faults.unless(page.locator(".says").inner_text().strip() != "", f"mode {mode} is not named")
    return modes


def check_keyboard(page, faults):
    """Tab reaches every control, in no more stops than there are."""
    page.evaluate("document.activeElement.blur()")
    # The numbers are set once, so that the order of the stops does not matter.
    count = page.evaluate(
        """() => {
            const all = [...document.querySelectorAll("a[href], button, select, input, summary, canvas, [tabindex='0']")];
            const shown = all.filter((e) => e.checkVisibility() && !e.disabled);
            shown.forEach((e, k) => (e.dataset.stop = k));
            return shown.length;
        }"""
    )
    reached = set()
    for _ in range(count + 40):
        page.keyboard.press("Tab")
        stop = page.evaluate("document.activeElement?.dataset?.stop ?? null")
        if stop is not None:
            reached.add(int(stop))
        if len(reached) == count:
            break
    missed = sorted(set(range(count)) - reached)
    if missed:
        names = page.evaluate("(missed) => missed.map((k) => document.querySelector(`[data-stop='${k}']`).outerHTML.slice(0, 90))", missed[:5])
        faults.unless(False, f"{len(missed)} of {count} controls are not reached by Tab: {names}")
    return count


def check_accessibility(page, faults):
    found = Axe().run(page).response["violations"]
    for violation in found:
        if violation["impact"] in ("serious", "critical"):
            where = violation["nodes"][0]["html"][:120]
            faults.unless(False, f"axe {violation['id']} ({violation['impact']}, {len(violation['nodes'])}): {where}")


def check_print(page, faults):
    """On paper nothing is wider than the page, every figure is loaded, tables keep their headings."""
    page.emulate_media(media="print")
    page.evaluate("dispatchEvent(new Event('beforeprint'))")
    page.wait_for_function("[...document.images].every((image) => image.complete && image.naturalWidth > 0)", timeout=20_000)
    wide = page.evaluate(
        """(width) => [...document.querySelectorAll(".plot .main-svg, img, table")]
            .filter((e) => e.checkVisibility() && e.getBoundingClientRect().width > width + 2)
            .map((e) => e.outerHTML.slice(0, 80))""",
        PRINTED_WIDTH,
    )
    faults.unless(not wide, f"wider than a printed page: {wide[:3]}")
    hidden = page.evaluate("[...document.querySelectorAll('th .sort')].filter((e) => e.closest('details') === null && !e.checkVisibility()).length")
    faults.unless(hidden == 0, f"{hidden} headings of tables are not printed")
    page.evaluate("dispatchEvent(new Event('afterprint'))")
    page.emulate_media(media="screen")


def check(browser, path, results_path, shots):
    faults = Faults(path)
    page = open_page(browser, path, faults, viewport={"width": 1280, "height": 900})
    draw_all(page)
    with h5py.File(results_path) as results:
        curves = check_curves(page, faults)
        hovers = check_hovers(page, results, faults)
        bearings = check_bearings(page, results, faults)
        modes = check_shapes(page, results, faults)
    controls = check_keyboard(page, faults)
    check_accessibility(page, faults)
    page.locator("#theme").click()
    page.wait_for_timeout(300)
    check_accessibility(page, faults)
    page.set_viewport_size({"width": PRINTED_WIDTH, "height": 1000})
    check_print(page, faults)
    if shots:
        take_shots(browser, path, faults, shots)
    page.close()
    print(f"{path}: {curves} charts, {hovers} hovers, {bearings} bearings, {modes} modes, {controls} controls, {len(faults.list)} faults")
    for fault in faults.list:
        print(f"  {fault}")
    return len(faults.list)


def check_opens(browser, path):
    """A page of a hostile model: every section is there, its texts are texts, and it fits a narrow window."""
    faults = Faults(path)
    page = open_page(browser, path, faults, viewport={"width": 400, "height": 900})
    draw_all(page)
    page.wait_for_timeout(300)
    faults.unless(page.locator("p.failed").count() == 0, f"a section failed: {page.locator('p.failed').all_text_contents()[:2]}")
    for summary in page.locator("details > summary").all():
        summary.click()
    foreign = page.evaluate("[...document.querySelectorAll('main [onclick], main [onerror], main script, main iframe')].map((e) => e.outerHTML.slice(0, 80))")
    faults.unless(not foreign, f"elements of the model's texts: {foreign[:3]}")
    wide = page.evaluate("document.documentElement.scrollWidth")
    faults.unless(wide <= 400, f"the page is {wide} px wide in a window of 400")
    page.close()
    print(f"{path}: opened, {len(faults.list)} faults")
    for fault in faults.list:
        print(f"  {fault}")
    return len(faults.list)


def take_shots(browser, path, faults, folder):
    stem = f"{path.parent.name}_{path.stem}"
    for name, width, scheme in [("light", 1280, "light"), ("dark", 1280, "dark"), ("narrow", 400, "light")]:
        page = open_page(browser, path, faults, viewport={"width": width, "height": 900}, color_scheme=scheme)
        draw_all(page)
        page.wait_for_timeout(1500)
        wide = page.evaluate("document.documentElement.scrollWidth")
        faults.unless(wide <= width, f"{name}: the page is {wide} px wide in a window of {width}")
        page.screenshot(path=str(folder / f"{stem}_{name}.png"), full_page=True)
        page.close()
    page = open_page(browser, path, faults)
    page.pdf(path=str(folder / f"{stem}.pdf"), prefer_css_page_size=True)
    page.close()


def main(arguments):
    shots = None
    if "--shots" in arguments:
        at = arguments.index("--shots")
        shots = Path(arguments[at + 1])
        shots.mkdir(parents=True, exist_ok=True)
        del arguments[at : at + 2]
    only_open = "--only-open" in arguments
    if only_open:
        arguments.remove("--only-open")
    chromium, *files = arguments
    pairs = list(zip(files[::2], files[1::2]))
    with sync_playwright() as play:
        browser = play.chromium.launch(executable_path=chromium, args=FLAGS)
        if only_open:
            faults = sum(check_opens(browser, Path(page).resolve()) for page in files)
        else:
            faults = sum(check(browser, Path(page).resolve(), results, shots) for page, results in pairs)
        browser.close()
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main(sys.argv[1:])
