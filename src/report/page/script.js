// What the page does beyond being read: other axes, sorting, picking, wiping. All of it works on the data in #data.
(() => {
  "use strict";
  const data = JSON.parse(document.getElementById("data").textContent);
  const $ = (id) => document.getElementById(id);
  const SVG = "http://www.w3.org/2000/svg";
  document.documentElement.classList.add("scripted");
  let picked = -1;

  const element = (name, attributes, text) => {
    const e = document.createElementNS(SVG, name);
    for (const key in attributes) e.setAttribute(key, attributes[key]);
    if (text !== undefined) e.textContent = text;
    return e;
  };
  const short = (v) => {
    if (v === null || !isFinite(v)) return "\u221E";
    const a = Math.abs(v);
    return a >= 999.5 && a < 1e6 ? v.toFixed(0) : String(Number(v.toPrecision(3)));
  };
  const text = (m, v) => short(v) + (m.unit === "%" && v !== null && isFinite(v) ? " %" : "");
  const fill = (select, names, chosen) => {
    names.forEach(([value, name]) => {
      const option = document.createElement("option");
      option.value = value;
      option.textContent = name;
      option.selected = value === chosen;
      select.append(option);
    });
  };
  const measure = (key) => data.measures.findIndex((m) => m.key === key);
  const label = (m) => m.name + (m.unit ? ", " + m.unit : "");

  // The first chart: the layout is that of the drawing in the page.
  const box = { left: 74, right: 660, top: 34, bottom: 400 };
  const axis = (values) => {
    const positive = values.filter((v) => v !== null && isFinite(v) && v > 0);
    const low = (positive.length ? Math.min(...positive) : 0.1) / 1.25;
    const high = (positive.length ? Math.max(...positive) : 1) * 1.25;
    const place = (v) => {
      if (v === null || v === Infinity) return 1;
      return v > 0 ? Math.min(1, Math.max(0, Math.log(v / low) / Math.log(high / low))) : 0;
    };
    const ticks = [];
    const decades = Math.log10(high / low);
    const digits = decades > 4 ? [1] : decades > 1.5 ? [1, 3] :
      decades > 0.8 ? [1, 1.5, 2, 3, 5, 7] : [1, 1.2, 1.4, 1.6, 1.8, 2, 2.5, 3, 3.5, 4, 5, 6, 7, 8, 9];
    for (let e = Math.floor(Math.log10(low)); Math.pow(10, e) <= high; ++e)
      for (const d of digits) {
        const v = d * Math.pow(10, e);
        if (v >= low && v <= high) ticks.push(v);
      }
    return { place, ticks };
  };
  const front = (points) => {
    const best = [];
    points.filter((p) => p.x !== null && p.y !== null).sort((a, b) => a.x - b.x || a.y - b.y).forEach((p) => {
      if (!best.length || p.y < best[best.length - 1].y) best.push(p);
    });
    return best;
  };
  const state = { scene: data.start, error: measure("wrong"), cost: measure("total_ms") };

  // A selection as the end of the address, by names: it holds after the report is written anew.
  function fromAddress() {
    const asked = new URLSearchParams(location.hash.slice(1));
    const scene = data.scenes.indexOf(asked.get("scene")), technique = data.techniques.findIndex((t) => t.name === asked.get("technique"));
    if (scene >= 0 && measured(scene).length) state.scene = scene;
    for (const key of ["error", "cost"]) {
      const m = measure(asked.get(key));
      if (m >= 0 && data.measures[m].cost === (key === "cost")) state[key] = m;
    }
    return technique;
  }
  function toAddress() {
    const chosen = { scene: data.scenes[state.scene], error: data.measures[state.error].key, cost: data.measures[state.cost].key };
    if (picked >= 0) chosen.technique = data.techniques[picked].name;
    history.replaceState(null, "", "#" + new URLSearchParams(chosen));
  }
  const measured = (scene) => data.techniques.map((_, t) => t).filter((t) => data.cells[scene][t]);
  const points_of = () => measured(state.scene).map((t) =>
    ({ t, x: data.cells[state.scene][t][state.cost], y: data.cells[state.scene][t][state.error] }))
    .filter((p) => p.x !== null);  // a cost that was not measured

  function drawChart() {
    const svg = $("error-time"), points = points_of();
    const x = axis(points.map((p) => p.x)), y = axis(points.map((p) => p.y));
    const px = (v) => box.left + (box.right - box.left) * x.place(v);
    const py = (v) => box.bottom - (box.bottom - box.top) * y.place(v);
    const axes = svg.querySelector(".axes"), plot = svg.querySelector(".plot");
    axes.replaceChildren(element("text", { class: "title", x: box.left, y: 20 },
      "Error against run time: " + data.scenes[state.scene]));
    for (const v of x.ticks) {
      axes.append(element("path", { class: "grid", d: `M${px(v)},${box.top}V${box.bottom}` }),
        element("text", { "text-anchor": "middle", x: px(v), y: box.bottom + 18 }, short(v)));
    }
    for (const v of y.ticks) {
      axes.append(element("path", { class: "grid", d: `M${box.left},${py(v)}H${box.right}` }),
        element("text", { "text-anchor": "end", x: box.left - 8, y: py(v) + 4 }, short(v)));
    }
    axes.append(
      element("rect", { class: "frame", x: box.left, y: box.top, width: box.right - box.left,
        height: box.bottom - box.top }),
      element("text", { "text-anchor": "middle", x: (box.left + box.right) / 2, y: box.bottom + 42 },
        label(data.measures[state.cost])),
      element("text", { "text-anchor": "middle",
        transform: `translate(16,${(box.top + box.bottom) / 2})rotate(-90)` }, label(data.measures[state.error])));
    plot.replaceChildren();
    let path = "";
    const best = front(points);
    best.forEach((p, i) => {
      path += (i ? `H${px(p.x)}V${py(p.y)}` : `M${px(p.x)},${py(p.y)}`);
    });
    if (path) plot.append(element("path", { class: "front", d: path }));
    points.sort((a, b) => a.x - b.x);  // arrow keys go from left to right
    for (const p of points) {
      const t = data.techniques[p.t];
      const mark = element("path", { class: "mark " + t.color, d: data.marks[t.mark], "data-id": p.t,
        transform: `translate(${px(p.x)},${py(p.y)})`, role: "button", "aria-label": tip(p.t) });
      mark.append(element("title", {}, tip(p.t)));
      plot.append(mark);
    }
    oneStop([...plot.querySelectorAll(".mark")]);
    showPicked(false);
  }

  // Of many elements, Tab enters one; arrow keys go on from there.
  function oneStop(elements) {
    const first = elements.find((e) => e.classList.contains("picked")) || elements[0];
    elements.forEach((e) => e.setAttribute("tabindex", e === first ? 0 : -1));
  }

  function stepFrom(element, elements, step) {
    const next = elements[elements.indexOf(element) + step];
    if (!next) return;
    elements.forEach((e) => e.setAttribute("tabindex", e === next ? 0 : -1));
    next.focus();
  }

  const tip = (t) => {
    const values = data.cells[state.scene][t];
    const error = data.measures[state.error], cost = data.measures[state.cost];
    return data.techniques[t].name + "; " + error.column + " " + text(error, values[state.error]) +
      "; " + cost.column + " " + text(cost, values[state.cost]);
  };

  function showPicked(scroll) {
    document.querySelectorAll(".picked").forEach((e) => e.classList.remove("picked"));
    $("details").textContent = "";
    if (picked < 0) return;
    document.querySelectorAll(`[data-id="${picked}"]`).forEach((e) => e.classList.add("picked"));
    const values = data.cells[state.scene][picked];
    if (values) {
      $("details").textContent = data.techniques[picked].name + ": " +
        data.measures.map((m, i) => m.column + " " + text(m, values[i])).join(" \u00B7 ");
    }
    const row = document.querySelector(`#summary tbody[data-scene="${state.scene}"] tr[data-id="${picked}"]`);
    // The page stays where it is: only the table's own window moves.
    if (scroll && row) row.closest(".tall").scrollTop = row.offsetTop - 120;
  }

  function pick(t, scroll) {
    picked = t;
    toAddress();
    showPicked(scroll);
    document.querySelectorAll(".viewer").forEach((v) => v.show && v.show(t));
  }

  function showScene() {
    document.querySelectorAll("#summary tbody, .by-scene").forEach((b) => {
      b.hidden = Number(b.dataset.scene) !== state.scene;
    });
    markDominated();
    oneStop(rows());
    drawChart();
  }

  const rows = () => [...document.querySelectorAll(`#summary tbody[data-scene="${state.scene}"] tr.row`)];

  function markDominated() {
    const best = new Set(front(points_of()).map((p) => p.t));
    rows().forEach((row) => {
      const is_best = best.has(Number(row.dataset.id));
      row.classList.toggle("dominated", !is_best);
      row.cells[1].textContent = is_best ? "front" : "";
    });
  }

  function sortBy(column, head) {
    const descending = head.getAttribute("aria-sort") === "ascending";
    document.querySelectorAll("#summary th").forEach((h) => h.removeAttribute("aria-sort"));
    head.setAttribute("aria-sort", descending ? "descending" : "ascending");
    document.querySelectorAll("#summary tbody").forEach((body) => {
      const key = (row) => {
        const cell = row.cells[column];
        if (cell.dataset.v === undefined) return cell.textContent;
        return cell.dataset.v === "" ? Infinity : Number(cell.dataset.v);
      };
      const rows = [...body.querySelectorAll("tr.row")];
      rows.sort((a, b) => {
        const x = key(a), y = key(b);
        const order = typeof x === "string" ? x.localeCompare(y, "en", { numeric: true }) : x === y ? 0 : x - y;
        return descending ? -order : order;
      });
      body.append(...rows);
    });
  }

  function makeViewer(viewer) {
    const scene = Number(viewer.dataset.scene), pictures = data.pictures[scene];
    const select = viewer.querySelector("select.technique");
    const left = viewer.querySelector("select.left"), right = viewer.querySelector("select.right");
    const under = viewer.querySelector("img.under"), over = viewer.querySelector("img.over");
    const edge = viewer.querySelector(".edge"), wipe = viewer.querySelector(".wipe");
    const kinds = [["truth", "exact shadow"], ["mask", "technique"], ["difference", "difference"],
      ["heat", "aliasing error m"], ["image", "picture"]];
    fill(select, Object.keys(pictures.of).map((t) => [t, data.techniques[t].name]), String(pictures.first));
    fill(left, kinds, "truth");
    fill(right, kinds, "mask");
    const source = (kind) => "data:image/png;base64," +
      data.images[kind === "truth" || kind === "image" ? pictures[kind] : pictures.of[select.value][kind]];
    const update = () => {
      under.src = source(right.value);
      under.alt = right.selectedOptions[0].textContent;
      over.src = source(left.value);
      over.alt = left.selectedOptions[0].textContent;
      over.style.clipPath = `inset(0 ${100 - wipe.value}% 0 0)`;
      edge.style.left = wipe.value + "%";
    };
    for (const input of [select, left, right, wipe]) input.addEventListener("input", update);
    viewer.show = (t) => {
      if (!pictures.of[t]) return;
      select.value = String(t);
      update();
    };
    update();
  }

  const asked = fromAddress();
  const errors = data.measures.filter((m) => !m.cost).map((m) => [m.key, m.name]);
  const costs = data.measures.filter((m) => m.cost).map((m) => [m.key, m.name]);
  fill($("scene"), data.scenes.map((s, i) => [String(i), s]).filter(([i]) => measured(i).length), String(state.scene));
  fill($("error"), errors, data.measures[state.error].key);
  fill($("cost"), costs, data.measures[state.cost].key);
  $("scene").addEventListener("input", (e) => { state.scene = Number(e.target.value); toAddress(); showScene(); });
  $("error").addEventListener("input", (e) => { state.error = measure(e.target.value); toAddress(); markDominated(); drawChart(); });
  $("cost").addEventListener("input", (e) => { state.cost = measure(e.target.value); toAddress(); markDominated(); drawChart(); });
  document.querySelectorAll("#summary th").forEach((head, column) => {
    const button = document.createElement("button");
    button.textContent = head.textContent;
    button.addEventListener("click", () => sortBy(column, head));
    head.replaceChildren(button);
  });
  document.addEventListener("click", (e) => {
    const mark = e.target.closest("svg [data-id]"), row = e.target.closest("#summary tr.row");
    if (mark) pick(Number(mark.dataset.id), true);
    else if (row) pick(Number(row.dataset.id), false);
  });
  document.addEventListener("keydown", (e) => {
    const mark = e.target.closest && e.target.closest("#error-time [data-id]");
    const row = e.target.closest && e.target.closest("#summary tr.row");
    const at = mark || row;
    if (!at) return;
    const step = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[e.key];
    if (e.key === "Enter" || e.key === " ") pick(Number(at.dataset.id), Boolean(mark));
    else if (step) stepFrom(at, mark ? [...document.querySelectorAll("#error-time .mark")] : rows(), step);
    else return;
    e.preventDefault();  // the page would scroll
  });
  $("error-time").setAttribute("role", "group");
  $("error-time").addEventListener("focusin", (e) => {
    const mark = e.target.closest("[data-id]");
    if (mark) $("details").textContent = tip(Number(mark.dataset.id));
  });
  $("error-time").addEventListener("pointerover", (e) => {
    const mark = e.target.closest("[data-id]");
    if (mark && picked < 0) $("details").textContent = tip(Number(mark.dataset.id));
  });
  document.querySelectorAll(".viewer").forEach(makeViewer);

  // A word above each box that holds more than it shows.
  document.querySelectorAll(".wide").forEach((box) => {
    const hint = document.createElement("p");
    hint.className = "note hint";
    box.before(hint);
    const update = () => {
      const sideways = box.scrollWidth > box.clientWidth + 1, down = box.scrollHeight > box.clientHeight + 1;
      hint.textContent = sideways ? (down ? "Scrolls sideways and down." : "Scrolls sideways.") : "Scrolls down.";
      hint.hidden = !sideways && !down;
    };
    new ResizeObserver(update).observe(box);
    update();
  });
  showScene();
  if (asked >= 0 && data.cells[state.scene][asked]) pick(asked, true);
  window.addEventListener("hashchange", () => {
    if (!location.hash.includes("=")) return;  // a place within the page
    const t = fromAddress();
    $("scene").value = String(state.scene);
    $("error").value = data.measures[state.error].key;
    $("cost").value = data.measures[state.cost].key;
    showScene();
    if (t >= 0 && data.cells[state.scene][t]) pick(t, true);
  });
})();
