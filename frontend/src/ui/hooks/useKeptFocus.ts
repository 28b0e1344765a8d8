import { useEffect, type RefObject } from 'react';

const TARGETS =
  'button:not([disabled]), a[href], input:not([disabled]), select:not([disabled]), textarea, [tabindex="0"]';

/**
 * Keeps the focus in a part of the page when its focused element goes away: it goes to the first control of what
 * came in that place, so that the keys continue there. Without it the browser would begin at the top of the page.
 */
export function useKeptFocus(part: RefObject<HTMLElement | null>): void {
  useEffect(() => {
    const element = part.current;
    if (!element) return undefined;
    let around: readonly Element[] = [];
    const remember = ({ target }: FocusEvent) => {
      const found: Element[] = [];
      for (let at = target as Element | null; at && at !== element; at = at.parentElement) found.push(at);
      around = [...found, element];
    };
    const forget = ({ relatedTarget }: FocusEvent) => {
      if (relatedTarget && !element.contains(relatedTarget as Node)) around = [];
    };
    const observer = new MutationObserver(() => {
      const [last] = around;
      if (!last || last.isConnected || document.activeElement !== document.body) return;
      for (const each of around) {
        const next = each.isConnected ? each.querySelector<HTMLElement>(TARGETS) : null;
        if (next) {
          next.focus();
          return;
        }
      }
    });
    element.addEventListener('focusin', remember);
    element.addEventListener('focusout', forget);
    observer.observe(element, { childList: true, subtree: true });
    return () => {
      observer.disconnect();
      element.removeEventListener('focusin', remember);
      element.removeEventListener('focusout', forget);
    };
  }, [part]);
}
