/*
 * Answers some properties of `getComputedStyle` without applying each rule of jsdom's style sheet to each element
 * above: queries by role and name, and whatever floats, ask for them again and again. Any other property, and what
 * a rule of the page or a rare attribute could decide, is left to jsdom.
 */
const KEY = Symbol.for('bt-studio/quick-style');
const compute = window.getComputedStyle.bind(window);

/** Properties that an element does not inherit: they follow from its name and its own style. */
export const OWN = [
  'display',
  'overflow',
  'overflowX',
  'overflowY',
  'position',
  'transform',
  'translate',
  'scale',
  'rotate',
  'perspective',
  'filter',
  'backdropFilter',
  'contain',
  'containerType',
  'willChange',
] as const;
/** Inherited properties, with the attribute that may set each, and its initial value. */
export const INHERITED = {
  // A hidden part of a table is collapsed.
  visibility: ['hidden', 'visible'],
  direction: ['dir', 'ltr'],
} as const;

type Property = (typeof OWN)[number] | keyof typeof INHERITED;
const PROPERTIES = [...OWN, ...(Object.keys(INHERITED) as (keyof typeof INHERITED)[])];

/** What jsdom's style sheet gives to an element of a name, without regard to its attributes. */
const ofNames = new Map<string, CSSStyleDeclaration>();
const deciding = new WeakMap<CSSStyleSheet, { readonly rules: number; readonly decides: boolean }>();

/** Elements whose style depends on more than their name. */
const RARE = new Set(['details', 'dialog', 'embed', 'noscript', 'summary']);
/** No name that `getPropertyValue` knows. */
const CAMEL = /[A-Z]/;
const KEYWORDS = new Set(['inherit', 'initial', 'revert', 'revert-layer', 'unset']);

function decides(rule: CSSRule): boolean {
  const style = 'style' in rule ? (rule.style as CSSStyleDeclaration) : null;
  if (style && PROPERTIES.some((property) => style[property])) return true;
  return 'cssRules' in rule && [...(rule.cssRules as CSSRuleList)].some(decides);
}

/** Whether a style sheet of the page sets one of the properties anywhere. */
function pageDecides(): boolean {
  for (const sheet of document.styleSheets) {
    const rules = sheet.cssRules.length;
    let known = deciding.get(sheet);
    if (known?.rules !== rules)
      deciding.set(sheet, (known = { rules, decides: [...sheet.cssRules].some(decides) }));
    if (known.decides) return true;
  }
  return false;
}

const inline = (element: Element, property: Property): string =>
  element.hasAttribute('style') ? (element as HTMLElement | SVGElement).style[property] : '';

/** Returns null where only jsdom knows; so do the functions below. */
const plain = (value: string): string | null => (KEYWORDS.has(value) ? null : value);

function ofName(name: string): CSSStyleDeclaration {
  let style = ofNames.get(name);
  if (!style) ofNames.set(name, (style = compute(document.createElement(name))));
  return style;
}

function own(element: Element, property: (typeof OWN)[number]): string | null {
  const name = element.localName;
  if (RARE.has(name) || element.hasAttribute('hidden') || element.hasAttribute('popover')) return null;
  if (name === 'input' && element.getAttribute('type') === 'hidden') return null;
  return plain(inline(element, property) || ofName(name)[property]);
}

function inherited(element: Element, property: keyof typeof INHERITED): string | null {
  const [attribute, initial] = INHERITED[property];
  for (let at: Element | null = element; at; at = at.parentElement) {
    if (at.hasAttribute(attribute)) return null;
    const set = inline(at, property);
    if (set !== '') return plain(set);
  }
  return initial;
}

const QUICK = new Map<string | symbol, (element: Element) => string | null>([
  ...OWN.map((name) => [name, (element: Element) => own(element, name)] as const),
  ['visibility', (element) => inherited(element, 'visibility')],
  ['direction', (element) => inherited(element, 'direction')],
]);

function quickStyle(element: Element, pseudo?: string | null): CSSStyleDeclaration {
  if ((pseudo ?? null) !== null || !element.isConnected || pageDecides()) return compute(element, pseudo);
  const quick = (property: string | symbol): string | null => QUICK.get(property)?.(element) ?? null;
  let all: CSSStyleDeclaration | undefined;
  const others = (): CSSStyleDeclaration => (all ??= compute(element));
  return new Proxy({} as CSSStyleDeclaration, {
    get(_, name) {
      const known = quick(name);
      if (known !== null) return known;
      if (name === 'getPropertyValue')
        return (property: string) =>
          (CAMEL.test(property) ? null : quick(property)) ?? others().getPropertyValue(property);
      const value: unknown = Reflect.get(others(), name, others());
      return typeof value === 'function' ? (value.bind(others()) as unknown) : value;
    },
    has: (_, name) => name in others(),
  });
}

// All files of tests share the window.
if (!(KEY in window.getComputedStyle))
  window.getComputedStyle = Object.assign(quickStyle, { [KEY]: compute });
