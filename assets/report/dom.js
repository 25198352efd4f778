"use strict";
// Elements, tables and controls. All text is set as text, never as markup.

/** An element with attributes and children (elements or texts). */
function make(tag, attributes = {}, ...children) {
  const node = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith("on")) node.addEventListener(name.slice(2), value);
    else if (value !== false && value !== undefined && value !== null) node.setAttribute(name, value === true ? "" : value);
  }
  node.append(...children.filter((child) => child !== null && child !== undefined));
  return node;
}

let lastId = 0;
function freshId(prefix) {
  lastId += 1;
  return `${prefix}-${lastId}`;
}

/** A labelled list to choose from; `choose` gets the index. */
function select(label, options, chosen, choose) {
  const id = freshId("select");
  const list = make("select", { id, onchange: (event) => choose(event.target.selectedIndex) });
  options.forEach((text, k) => list.append(make("option", { selected: k === chosen }, text)));
  return make("span", { class: "control" }, make("label", { for: id }, label), list);
}

/** A labelled slider over 0 … count − 1; `show` gives the text of a position. */
function slider(label, count, at, show, move) {
  const id = freshId("slider");
  const output = make("output", { for: id }, show(at));
  const input = make("input", { type: "range", id, min: 0, max: Math.max(count - 1, 0), step: 1, value: at, "aria-valuetext": show(at) });
  const set = (k) => {
    input.value = k;
    output.textContent = show(k);
    input.setAttribute("aria-valuetext", show(k));
  };
  input.addEventListener("input", () => {
    set(Number(input.value));
    move(Number(input.value));
  });
  const node = make("span", { class: "control wide" }, make("label", { for: id }, label), input, output);
  return { node, set };
}

/** A check box. */
function checkBox(label, checked, change) {
  const id = freshId("check");
  const box = make("input", { type: "checkbox", id, checked, onchange: (event) => change(event.target.checked) });
  return make("span", { class: "control" }, box, make("label", { for: id }, label));
}

/** Copies text, with the old command where the clipboard is closed to local files. */
function copyText(text, button) {
  const done = () => {
    const before = button.textContent;
    button.textContent = "Copied";
    setTimeout(() => (button.textContent = before), 1200);
  };
  const fallback = () => {
    const area = make("textarea", { "aria-hidden": true });
    area.value = text;
    document.body.append(area);
    area.select();
    document.execCommand("copy");
    area.remove();
    done();
  };
  if (navigator.clipboard) navigator.clipboard.writeText(text).then(done, fallback);
  else fallback();
}

/**
 * A table that sorts by a click on a column's head and copies as tab-separated text.
 * columns: [{ name, unit, values }]; values are numbers or texts.
 */
function table(caption, columns, { digits: count = 5, mark } = {}) {
  const rows = Array.from({ length: columns[0]?.values.length ?? 0 }, (_, k) => k);
  const body = make("tbody");
  const fill = () => {
    body.replaceChildren(
      ...rows.map((r) =>
        make(
          "tr",
          mark?.(r) ? { class: "marked" } : {},
          ...columns.map((column) => {
            const value = column.values[r];
            const number = typeof value === "number";
            return make("td", { class: number ? "number" : false }, number ? digits(value, column.digits ?? count) : String(value ?? "–"));
          }),
        ),
      ),
    );
  };
  const heads = columns.map((column) => {
    const name = column.unit && column.unit !== "1" ? `${column.name} [${column.unit}]` : column.name;
    const head = make("th", { scope: "col", "aria-sort": "none" });
    let rising = false;
    const sort = () => {
      rising = !rising;
      const sign = rising ? 1 : -1;
      const order = (a, b) => {
        const [x, y] = [column.values[a], column.values[b]];
        if (typeof x === "number" && typeof y === "number") {
          if (Number.isNaN(x) || Number.isNaN(y)) return Number.isNaN(x) - Number.isNaN(y);
          return sign * (x - y);
        }
        return sign * String(x).localeCompare(String(y), undefined, { numeric: true });
      };
      rows.sort(order);
      heads.forEach((h) => h.setAttribute("aria-sort", "none"));
      head.setAttribute("aria-sort", rising ? "ascending" : "descending");
      fill();
    };
    head.append(make("button", { type: "button", class: "sort", onclick: sort }, name));
    return head;
  });
  fill();
  const copy = make("button", { type: "button", class: "small" }, "Copy table");
  copy.addEventListener("click", () => {
    const line = (cells) => cells.join("\t");
    const head = line(columns.map((c) => (c.unit && c.unit !== "1" ? `${c.name} [${c.unit}]` : c.name)));
    copyText([head, ...rows.map((r) => line(columns.map((c) => String(c.values[r] ?? ""))))].join("\n"), copy);
  });
  return make(
    "figure",
    { class: "table" },
    make("figcaption", {}, caption, " ", copy),
    make("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": caption }, make("table", {}, make("thead", {}, make("tr", {}, ...heads)), body)),
  );
}
