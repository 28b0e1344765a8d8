import { expect, it, vi } from 'vitest';
import { answer } from './searchWorker';

it('answers a request with its hits', () => {
  const post = vi.spyOn(window, 'postMessage').mockImplementation(() => undefined);
  const query = { text: 'a', matchesCase: false, isWholeWord: false, isRegex: false };
  answer({ data: { query, replacement: null, texts: ['ba'] } });
  expect(post).toHaveBeenCalledWith({
    hits: [{ text: 0, start: 1, end: 2, replacement: '' }],
    isCut: false,
  });
  expect(self.onmessage).toBe(answer);
  self.onmessage = null;
});
