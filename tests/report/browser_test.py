# The report in a headless Chromium: no messages, no requests; mouse, keyboard, phone, light and dark.
# browser_test.py SAMPLE_REPORT FOLDER; 77 where there is no browser.
import os
import shutil
import subprocess
import sys

from browser import Browser

SKIP = 77


def check(condition, what):
    if not condition:
        sys.exit("failed: " + what)


def check_page(browser, page):
    browser.open(page)
    check(browser.complaints() == [], "the page complains: %s" % browser.complaints())
    check(browser.requests() == [], "the page asks for %s" % browser.requests())
    check(browser.value("document.querySelectorAll('section').length") == 7, "there are seven sections")
    check(browser.value("document.querySelectorAll('img[onerror], main script').length") == 0, "no name became an element")
    check("<script>alert(1)" in browser.value("document.getElementById('s2').innerText"), "names stand there as text")
    check("<b>bold</b>" in browser.value("document.getElementById('s5').innerText"), "stability stands there as text")


def check_picking(browser):
    marks = browser.value("[...document.querySelectorAll('#error-time .mark')].map(e => e.dataset.id)")
    check(len(marks) == 8, "a mark for each technique, not %d" % len(marks))
    for mark in (marks[0], marks[-1]):
        browser.click("#error-time .mark[data-id='%s']" % mark)
        picked = browser.value("[...document.querySelectorAll('#summary tbody:not([hidden]) tr.picked')].map(e => e.dataset.id)")
        check(picked == [mark], "a click on mark %s picks its row, not %s" % (mark, picked))
    check(browser.value("document.getElementById('details').textContent") != "", "details are shown")
    browser.click("#summary tbody:not([hidden]) tr[data-id='%s'] td" % marks[1])
    check(browser.value("document.querySelector('#error-time .mark.picked').dataset.id") == marks[1],
          "a click on a row picks its mark")


def check_controls(browser):
    browser.value("(() => { const s = document.getElementById('scene'); s.value = '1';"
                  "s.dispatchEvent(new Event('input')); })()")
    check(browser.value("document.querySelectorAll('#summary tbody:not([hidden])').length") == 1, "one scene's table")
    check(browser.value("document.querySelectorAll('.by-scene:not([hidden])').length") == 1, "one scene's second chart")
    browser.value("(() => { const s = document.getElementById('cost'); s.value = 'map_mib';"
                  "s.dispatchEvent(new Event('input')); })()")
    check("memory" in browser.value("document.querySelector('#error-time .axes').textContent"), "the axis changes")
    times = "[...document.querySelectorAll('#summary tbody:not([hidden]) tr.row')].map(r => Number(r.cells[2].dataset.v))"
    for order in (False, True):
        browser.click("#summary th:nth-child(3) button")
        check(browser.value(times) == sorted(browser.value(times), reverse=order), "a click on a head sorts")
    check(browser.value("document.querySelector('.viewer img.over').naturalWidth") == 1, "pictures are shown")
    browser.value("(() => { const w = document.querySelector('.viewer .wipe'); w.value = 25;"
                  "w.dispatchEvent(new Event('input')); })()")
    check("75%" in browser.value("document.querySelector('.viewer img.over').style.clipPath"), "the wipe moves")


def check_keyboard(browser):
    """Tab enters the chart once, arrow keys go from mark to mark, Enter picks; likewise the table's rows."""
    browser.value("document.getElementById('cost').focus()")
    focused = "(document.activeElement.getAttribute('class') || '') + ' ' + (document.activeElement.dataset.id || '')"
    for _ in range(3):  # the chart's box, then its marks
        browser.press("Tab")
        if browser.value(focused).startswith("mark"):
            break
    first = browser.value("document.activeElement.dataset.id")
    check(browser.value(focused).startswith("mark"), "Tab enters the chart, not " + browser.value(focused))
    browser.press("ArrowRight")
    second = browser.value("document.activeElement.dataset.id")
    check(second not in (None, first), "an arrow key goes to the next mark")
    check(browser.value("document.getElementById('details').textContent") != "", "a mark in focus shows its numbers")
    browser.press("Enter")
    check(browser.value("document.querySelector('#error-time .mark.picked').dataset.id") == second, "Enter picks a mark")
    stops = "[...document.querySelectorAll('%s')].filter(e => e.tabIndex === 0).length"
    check(browser.value(stops % "#error-time .mark") == 1, "one stop of Tab in the chart")
    check(browser.value(stops % "#summary tbody:not([hidden]) tr.row") == 1, "one stop of Tab in the table")
    browser.value("document.querySelector('#summary tbody:not([hidden]) tr.row').focus()")
    browser.press("ArrowDown")
    browser.press(" ")
    row = browser.value("document.activeElement.dataset.id")
    check(browser.value("document.querySelector('#error-time .mark.picked').dataset.id") == row, "Space picks a row")
    check(browser.value("[...document.querySelectorAll('.wide')].every(e => e.tabIndex === 0 && e.ariaLabel)"),
          "keyboards reach every box that scrolls")


def check_address(browser, page):
    """The address holds the selection, and leads back to it."""
    browser.open(page)
    mark = browser.value("document.querySelector('#error-time .mark').dataset.id")
    browser.click("#error-time .mark[data-id='%s']" % mark)
    browser.value("(e => { e.value = 'flips'; e.dispatchEvent(new Event('input', {bubbles: true})); })(document.getElementById('error'))")
    address = browser.value("location.hash")
    check("error=flips" in address and "technique=" in address, "the address holds the selection: %s" % address)
    browser.open("about:blank")
    browser.open(page + address)
    check(browser.complaints() == [], "complaints under an address: %s" % browser.complaints())
    check(browser.value("document.getElementById('error').value") == "flips", "the address brings the error back")
    check(browser.value("document.querySelector('#error-time .mark.picked').dataset.id") == mark, "and the technique")
    browser.open("about:blank")
    browser.open(page + "#scene=nowhere&error=total_ms&cost=x&technique=%3Cb%3E")
    check(browser.complaints() == [], "complaints under a wrong address: %s" % browser.complaints())
    check(browser.value("document.getElementById('error').value") == "wrong", "what no page has changes nothing")


def check_percent(browser):
    """Shares read as percent, in the table, on the axis and beside the chart."""
    heads = browser.value("[...document.querySelectorAll('#summary th')].map(e => e.textContent.trim())")
    column = heads.index("misclassified")
    cells = browser.value("[...document.querySelectorAll('#summary tr.row')].map(r => r.cells[%d].textContent)" % column)
    check(cells and all(c.endswith(" %") for c in cells), "shares in the table are percent: %s" % cells)
    first = browser.value("Number(document.querySelector('#summary tr.row').cells[%d].dataset.v)" % column)
    check(abs(float(cells[0][:-2]) - 100 * first) <= 0.005 * 100 * first, "%s is 100 times %s" % (cells[0], first))
    check("%" in browser.value("document.querySelector('#error-time .axes').textContent"), "the axis is in percent")


def check_phone(browser, page):
    """At 390 px only boxes scroll sideways, their text can be read, and a word says that they scroll."""
    browser.open(page, 390, 844)
    check(browser.value("document.documentElement.scrollWidth") <= 390, "the page itself does not scroll sideways")
    scale = browser.value("document.querySelector('.chart').getBoundingClientRect().width / 940")
    check(12 * scale >= 10.5, "text in charts is %.1f px high" % (12 * scale))
    boxes = browser.value("[...document.querySelectorAll('.wide')].map(e => [e.scrollWidth > e.clientWidth + 1,"
                          "!e.previousElementSibling.hidden && e.previousElementSibling.textContent])")
    check(any(wide for wide, _ in boxes), "some box scrolls")
    for wide, hint in boxes:
        check(not wide or "sideways" in (hint or ""), "a box that scrolls sideways says so")


def luminance(color):
    parts = [int(c) / 255 for c in color[color.index("(") + 1:-1].split(",")[:3]]
    linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in parts]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def check_contrast(browser, page):
    """WCAG 2.1's contrast for text, 4.5 to 1, on a light and on a dark screen."""
    backs = []
    for scheme in ("light", "dark"):
        browser.colors(scheme)
        browser.open(page)
        back = luminance(browser.value("getComputedStyle(document.body).backgroundColor"))
        backs.append(back)
        for selector in ("body", ".note", "a", ".sub", ".bar label"):
            text = luminance(browser.value("getComputedStyle(document.querySelector('%s')).color" % selector))
            ratio = (max(text, back) + 0.05) / (min(text, back) + 0.05)
            check(ratio >= 4.5, "%s has a contrast of %.1f on a %s screen" % (selector, ratio, scheme))
    check(backs[0] > 0.5 > backs[1], "the page follows the reader's colours")
    browser.colors("light")


def check_without_scripts(browser, page):
    browser.call("Emulation.setScriptExecutionDisabled", value=True)
    browser.open(page)
    check(browser.complaints() == [], "complaints without scripts: %s" % browser.complaints())
    visible = "[...document.querySelectorAll('%s')].filter(e => e.getClientRects().length > 0).length"
    check(browser.value(visible % "#summary tbody tr.row") == 24, "all tables can be read")
    check(browser.value(visible % ".plainly img") == 8, "all pictures can be seen")
    check(browser.value(visible % "#error-time .mark") == 8, "the chart can be read")
    check(browser.value(visible % ".script") == 0, "controls that would do nothing are hidden")


def main():
    program = shutil.which("chromium") or shutil.which("chromium-browser")
    if program is None:
        print("skipped: no chromium here")
        return SKIP
    sample, folder = sys.argv[1:3]
    shutil.rmtree(folder, ignore_errors=True)
    page = subprocess.run([sample, folder], check=True, capture_output=True, text=True).stdout.strip()
    check(os.path.exists(page), page + " was written")
    with Browser(program) as browser:
        check_page(browser, page)
        check_picking(browser)
        check_controls(browser)
        check(browser.complaints() == [], "the page complains after use: %s" % browser.complaints())
        check_percent(browser)
        check_address(browser, page)
        browser.open(page)
        check_keyboard(browser)
        check_phone(browser, page)
        check(browser.complaints() == [], "the page complains on a phone: %s" % browser.complaints())
        check_contrast(browser, page)
        browser.screenshot(os.path.join(folder, "screenshot.png"))
        check_without_scripts(browser, page)
    return 0


if __name__ == "__main__":
    sys.exit(main())
