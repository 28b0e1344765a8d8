import { closeHoverTooltips, hasHoverTooltips, ViewPlugin } from '@codemirror/view';

/** Escape closes what a pointer shows, also while the editor has no focus; it does nothing else then. */
export const escapeClosesHover = ViewPlugin.define((view) => {
  const close = (event: KeyboardEvent) => {
    if (event.key !== 'Escape' || !hasHoverTooltips(view.state)) return;
    event.preventDefault();
    event.stopPropagation();
    view.dispatch({ effects: closeHoverTooltips });
  };
  window.addEventListener('keydown', close, true);
  return { destroy: () => window.removeEventListener('keydown', close, true) };
});
