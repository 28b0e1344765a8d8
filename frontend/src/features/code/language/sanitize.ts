const ALLOWED = new Set(
  'A B BLOCKQUOTE BR CODE DD DEL DL DT EM H1 H2 H3 H4 H5 H6 HR I LI OL P PRE S SPAN STRONG SUB SUP TABLE TBODY TD TH THEAD TR UL'.split(
    ' ',
  ),
);

function clean(node: Element): void {
  for (const child of [...node.children]) {
    clean(child);
    if (!ALLOWED.has(child.tagName)) {
      child.replaceWith(
        ...(/^(SCRIPT|STYLE|IFRAME|OBJECT|TEMPLATE)$/.test(child.tagName) ? [] : child.childNodes),
      );
      continue;
    }
    const href = child.tagName === 'A' ? (child.getAttribute('href') ?? '') : '';
    const tone = child.getAttribute('class');
    for (const { name } of [...child.attributes]) child.removeAttribute(name);
    if (child.tagName === 'SPAN' && tone) child.setAttribute('class', tone);
    if (/^https?:\/\//.test(href)) {
      child.setAttribute('href', href);
      child.setAttribute('target', '_blank');
      child.setAttribute('rel', 'noreferrer');
    }
  }
}

/**
 * Sanitizes the HTML of docstrings, whose authors are unknown: text and markup stay, active content is
 * removed.
 */
export function sanitizeHtml(html: string): string {
  const { body } = new DOMParser().parseFromString(html, 'text/html');
  clean(body);
  return body.innerHTML;
}
