import { describe, expect, it, onTestFinished } from 'vitest';
import { openSearch, setSearch, useSearchStore } from './searchStore';

function select(text: string): void {
  const element = document.createElement('p');
  element.textContent = text;
  document.body.append(element);
  document.getSelection()?.selectAllChildren(element);
  onTestFinished(() => {
    document.getSelection()?.removeAllRanges();
    element.remove();
    useSearchStore.setState(useSearchStore.getInitialState(), true);
  });
}

describe('openSearch', () => {
  it('requests the focus, with the selected text', () => {
    select(' speed ');
    openSearch();
    openSearch();
    expect(useSearchStore.getState()).toMatchObject({ text: 'speed', asked: 2 });
  });

  it.each(['', 'two\nlines', 'x'.repeat(300)])('keeps its text if %j is selected', (text) => {
    select(text);
    setSearch({ text: 'mine' });
    openSearch(document, { isReplacing: true });
    expect(useSearchStore.getState()).toMatchObject({ text: 'mine', isReplacing: true });
  });
});
