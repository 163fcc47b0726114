"use strict";
(() => {
  // --- what a click does, Enter and Space do ---
  addEventListener("keydown", event => {
    if ((event.key !== "Enter" && event.key !== " ") || !event.target.matches?.(".pressable")) return;
    event.preventDefault();
    event.target.click();
  });

  // --- tables: their heads sort by their columns ---
  const number = text => { const found = text.replace(/\u2212/g, "-").match(/^\s*[<>≤≥±]?\s*(-?[\d.]+(?:e[-+]?\d+)?)/i); return found ? Number(found[1]) : NaN; };
  function sort(head) {
    const table = head.closest("table"), body = table.tBodies[0], column = head.cellIndex;
    const down = head.getAttribute("aria-sort") === "ascending";
    for (const other of head.parentNode.cells) other.removeAttribute("aria-sort");
    head.setAttribute("aria-sort", down ? "descending" : "ascending");
    const rows = [...body.rows], keys = new Map(rows.map(row => [row, row.cells[column].textContent]));
    const numeric = rows.some(row => !isNaN(number(keys.get(row))));
    rows.sort((a, b) => {
      const [p, q] = [keys.get(a), keys.get(b)];
      if (!numeric) return p.localeCompare(q, undefined, { numeric: true });
      const [m, n] = [number(p), number(q)];
      if (isNaN(m) || isNaN(n)) return isNaN(m) - isNaN(n) || p.localeCompare(q, undefined, { numeric: true });
      return m - n;
    });
    if (down) rows.reverse();
    body.append(...rows);
  }
  for (const head of document.querySelectorAll("table.sortable thead th")) {
    head.tabIndex = 0;
    head.title = "sort";
    head.classList.add("pressable");
    head.addEventListener("click", () => sort(head));
  }

  // --- what is linked to is opened ---
  function open() {
    const target = location.hash && document.getElementById(decodeURIComponent(location.hash.slice(1)));
    for (let one = target; one; one = one.parentElement) if (one.tagName === "DETAILS") one.open = true;
    if (!target) return;
    dispatchEvent(new Event("shown")); // charts that open above it would push it out of sight
    target.scrollIntoView({ block: target.tagName === "TR" ? "center" : "start" });
    if (target.tabIndex < 0) target.tabIndex = -1;
    target.focus({ preventScroll: true }); // the next Tab goes on from there
  }
  addEventListener("hashchange", open);
  open();

  // --- folded parts ---
  const folded = () => [...document.querySelectorAll("details:not([open])")];
  for (const button of document.querySelectorAll(".unfold")) {
    const opened = new Set();
    button.addEventListener("click", () => {
      if (opened.size) { for (const one of opened) one.open = false; opened.clear(); }
      else for (const one of folded()) { one.open = true; opened.add(one); }
      button.textContent = opened.size ? "fold again" : "unfold all";
    });
  }
  const unfolded = []; // on paper: words, tables and drawings; a series keeps its title alone
  addEventListener("beforeprint", () => {
    for (const one of folded()) if (!one.querySelector(":scope > .chart, :scope > figure > .chart")) { one.open = true; unfolded.push(one); }
    dispatchEvent(new Event("shown"));
  });
  addEventListener("afterprint", () => { for (const one of unfolded.splice(0)) one.open = false; });
})();
