import { expect, it } from 'vitest';
import { INHERITED, OWN } from './computedStyle';

const PROPERTIES = [...OWN, ...(Object.keys(INHERITED) as (keyof typeof INHERITED)[])];
const original = Reflect.get(
  window.getComputedStyle,
  Symbol.for('bt-studio/quick-style'),
) as typeof getComputedStyle;

/** Reads the properties of each element of a page in one of two ways, both as a name and as a text. */
const read = (way: typeof getComputedStyle) =>
  [...document.querySelectorAll('*')].map((element) => [
    element.outerHTML,
    ...PROPERTIES.flatMap((name) => [way(element)[name], way(element).getPropertyValue(name)]),
    way(element).width,
  ]);

const PAGES = [
  '<p>a <b>b</b> <i style="display: none">c</i></p><div hidden><span>d</span></div>',
  '<div style="visibility: hidden"><p>a</p><p style="visibility: visible"><b>b</b></p></div>',
  '<div style="visibility: hidden"><p style="visibility: inherit">a</p><p style="visibility: initial">b</p></div>',
  '<hr><div style="overflow: auto; transform: scale(2); position: absolute"><pre style="overflow-x: clip">a</pre></div>',
  '<style>hr { transform: none } .off { overflow: scroll }</style><hr><p class="off">a</p>',
  '<span style="display: inherit">a</span><span style="display: unset">b</span>',
  '<table><thead hidden><tr><th>a</th></tr></thead><tbody><tr hidden><td><b>b</b></td></tr></tbody></table>',
  '<details><summary>a</summary><p>b</p></details><dialog>c</dialog><dialog open>d</dialog>',
  '<form><label>a <input></label><input type="hidden"><button>b</button><select><option>c</option></select></form>',
  '<svg style="overflow: visible"><title>a</title><g><text>b</text></g></svg><template><p>c</p></template>',
  '<div dir="rtl"><p>a</p><p style="direction: ltr"><b>b</b></p></div><div popover>c</div>',
  '<style>.off { display: none } @media screen { p { visibility: hidden } }</style><p class="off">a <b>b</b></p>',
];

it.each(PAGES)('finds the styles that jsdom finds: %s', (page) => {
  document.body.innerHTML = page;
  expect(read(window.getComputedStyle)).toEqual(read(original));
});

it('follows a style sheet that is added or changed', () => {
  document.body.innerHTML = '<style></style><p>a</p>';
  const display = () => window.getComputedStyle(document.querySelector('p')!).display;
  expect(display()).toBe('block');
  document.styleSheets[document.styleSheets.length - 1]!.insertRule('p { display: flex }');
  expect(display()).toBe('flex');
  document.body.innerHTML = '<p>a</p>';
  expect(display()).toBe('block');
});

it('leaves an element that is on no page to jsdom', () => {
  const element = document.createElement('p');
  expect(window.getComputedStyle(element).visibility).toBe(original(element).visibility);
});
