# The report in a headless Chromium: silent, asks for nothing, and does what it is clicked for.
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
        browser.screenshot(os.path.join(folder, "screenshot.png"))
        check_without_scripts(browser, page)
    return 0


if __name__ == "__main__":
    sys.exit(main())
