import { create } from 'zustand';
import { letGoOfDocument } from '@/workspace/focus';
import { showPanel } from '@/workspace/tabs';

interface SearchData {
  readonly text: string;
  readonly matchesCase: boolean;
  readonly isWholeWord: boolean;
  readonly isRegex: boolean;
  readonly replacement: string;
  /** Whether the row for the replacement is shown. */
  readonly isReplacing: boolean;
  /** Increases with each request to focus the search field. */
  readonly asked: number;
}

/** The search. It outlives the panel, but is not saved. */
export const useSearchStore = create<SearchData>(() => ({
  text: '',
  matchesCase: false,
  isWholeWord: false,
  isRegex: false,
  replacement: '',
  isReplacing: false,
  asked: 0,
}));

export const setSearch = (patch: Partial<SearchData>): void => useSearchStore.setState(patch);

/**
 * Returns the selected text of the page if it is short and on one line, otherwise an empty text: a whole file
 * is not meant as a search.
 */
function selectedText(page: Document): string {
  const text = page.getSelection()?.toString() ?? '';
  return text.length <= 200 && !/[\r\n]/.test(text) ? text.trim() : '';
}

/** Shows the search panel, with the selected text in its field. */
export function openSearch(page: Document = document, patch: Partial<SearchData> = {}): void {
  const text = selectedText(page);
  letGoOfDocument();
  showPanel('search');
  useSearchStore.setState(({ asked }) => ({ ...(text ? { text } : {}), ...patch, asked: asked + 1 }));
}
