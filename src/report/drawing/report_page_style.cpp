#include "report_page.hpp"

namespace hamjet::io {

// Every plot is drawn twice, wide and narrow, because letters that are scaled down with a wide plot
// could not be read on a narrow window; paper gets the wide one. In the dark the plots are
// inverted, and their hues turned back: white becomes the page's ground. A box that scrolls has a
// shadow at each edge behind which there is more; covers that scroll with the table hide it at the
// ends.
const char* const page_style = R"(
:root { color-scheme: light dark; --ground: #fff; --ink: #1a1a1a; --faint: #444; --line: #ddd;
  --rule: #666; --code: #f6f6f6; --warning: #FFF4EC; --failed: #8A2F00; --shadow: #0003; }
@media screen and (prefers-color-scheme: dark) {
  :root { --ground: #1a1a1a; --ink: #e6e6e6; --faint: #b5b5b5; --line: #444; --rule: #999;
    --code: #262626; --warning: #3a2416; --failed: #FFB08A; --shadow: #fff4; }
  figure svg { filter: invert(.9) hue-rotate(180deg); }
}
* { box-sizing: border-box; }
body { margin: 0 auto; padding: 1rem; max-width: 84rem; background: var(--ground); color: var(--ink);
  font: 16px/1.5 system-ui, -apple-system, "Segoe UI", Roboto, "DejaVu Sans", sans-serif; }
h1 { font-size: 1.45rem; line-height: 1.25; margin: 0 0 .4rem; overflow-wrap: anywhere; }
h2 { font-size: 1.2rem; margin: 2.2rem 0 .5rem; border-top: 1px solid var(--line); padding-top: 1rem; }
p, figcaption { max-width: 48rem; }
.verdict { font-size: 1.12rem; margin: 0 0 .6rem; max-width: 66rem; overflow-wrap: anywhere; }
.partial, .problem { border: 2px solid #D55E00; background: var(--warning); padding: .5rem .8rem;
  max-width: none; }
.first { display: grid; grid-template-columns: minmax(0, 1fr) 20rem; gap: 1.5rem; }
.first dl { margin: 0; font-size: .92rem; }
dt { font-weight: 600; }
dd { margin: 0 0 .6rem; overflow-wrap: anywhere; }
figure { margin: 0; }
figure svg { display: block; width: 100%; max-width: 100%; height: auto; }
figure .wide svg { max-width: 62rem; }
figcaption { font-size: .95rem; margin-top: .4rem; }
.note { font-size: .9rem; color: var(--faint); margin: .3rem 0; }
.narrow { display: none; }
.panels { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(20rem, 100%), 1fr));
  gap: 1rem; max-width: 78rem; }
pre, code { font-family: ui-monospace, "DejaVu Sans Mono", Menlo, monospace; font-size: .88rem; }
pre { overflow-x: auto; background: var(--code); padding: .6rem .8rem; }
dd code { overflow-wrap: anywhere; }
.scroll { overflow-x: auto; margin: 0 0 1.4rem; max-width: 100%; width: fit-content;
  background: linear-gradient(to right, var(--ground) 1.5rem, transparent) left / 3rem 100% local,
    linear-gradient(to left, var(--ground) 1.5rem, transparent) right / 3rem 100% local,
    linear-gradient(to right, var(--shadow), transparent) left / .9rem 100% scroll,
    linear-gradient(to left, var(--shadow), transparent) right / .9rem 100% scroll;
  background-repeat: no-repeat; background-color: var(--ground); }
.hint { display: none; color: var(--faint); }
table { border-collapse: collapse; font-size: .88rem; font-variant-numeric: tabular-nums; }
.caption { font-size: .92rem; margin: 1rem 0 .3rem; }
th, td { padding: .2rem .6rem; border-bottom: 1px solid var(--line); text-align: right;
  white-space: nowrap; }
thead th { border-bottom: 2px solid var(--rule); vertical-align: bottom; white-space: normal;
  min-width: 4.5rem; }
th[scope=colgroup] { text-align: center; }
th[scope=row], thead tr:first-child th:first-child { text-align: left; position: sticky; left: 0;
  background: var(--ground); }
th[scope=row] { font-weight: 500; }
thead th:first-child, thead th.text { text-align: left; }
td.reason { text-align: left; white-space: normal; min-width: 16rem; }
tr.failed td { color: var(--failed); }
tr.left-out td { color: var(--faint); font-style: italic; }
.first.without-plot { display: block; }
@media screen and (max-width: 60rem) {
  .first { grid-template-columns: minmax(0, 1fr); }
}
@media screen and (max-width: 40rem) {
  body { padding: .8rem; }
  .wide { display: none; }
  .narrow { display: block; }
  .hint { display: inline; }
  th[scope=row] { min-width: 8rem; max-width: 9.5rem; white-space: normal;
    overflow-wrap: break-word; }
}
@media print {
  body { max-width: none; padding: 0; font-size: 10pt; }
  .first { display: block; }
  figure, tr { break-inside: avoid; }
  h2 { break-after: avoid; }
  .scroll { overflow: visible; background: none; }
  table { font-size: 7pt; }
  th, td { padding: .1rem .25rem; white-space: normal; }
  thead th { min-width: 0; }
  th[scope=row], thead tr:first-child th:first-child { position: static; }
}
)";

}  // namespace hamjet::io
