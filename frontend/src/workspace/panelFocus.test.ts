import { afterEach, beforeEach, expect, it } from 'vitest';
import { focusPanel } from './panelFocus';

beforeEach(() => {
  // The document of the tests draws nothing.
  Element.prototype.checkVisibility = function (this: Element) {
    return this.closest('[hidden]') === null;
  };
  document.body.innerHTML = `
    <header><button disabled>Undo</button><button id="run">Run</button></header>
    <div role="tabpanel"><button>Tool</button><div id="tree" data-testid="canvas" tabindex="0"></div></div>
    <div role="tabpanel" hidden><button>Behind</button></div>
    <div role="tabpanel"><p>Nothing to press</p></div>
    <div role="tabpanel"><input id="search" /></div>
    <section data-testid="time-axis"><button id="play">Play</button></section>`;
});
afterEach(() => document.body.replaceChildren());

const round = (step: 1 | -1, times: number) =>
  Array.from({ length: times }, () => {
    focusPanel(step);
    return document.activeElement?.id;
  });

it('goes from panel to panel and round, to what is edited first, past what is hidden or has no target', () => {
  expect(round(1, 5)).toEqual(['run', 'tree', 'search', 'play', 'run']);
});

it('goes back', () => {
  expect(round(-1, 4)).toEqual(['play', 'search', 'tree', 'run']);
});

it('says that there is nothing else', () => {
  document.body.innerHTML = '<header><button id="only">A</button></header>';
  expect([focusPanel(1), focusPanel(1)]).toEqual([true, false]);
  document.body.replaceChildren();
  expect(focusPanel(-1)).toBe(false);
});
