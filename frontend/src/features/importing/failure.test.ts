import { expect, it } from 'vitest';
import { ApiError } from '@/api/errors';
import '@/i18n/editorTexts';
import { t } from '@/i18n';
import { failuresOf, placeOf } from './failure';
import { PackError } from './pack';

const of = (error: Error) => failuresOf(t as unknown as Parameters<typeof failuresOf>[0], error);

it('has a text for what the page refuses, and for what the server cannot do', () => {
  expect(placeOf('a.xacro', 3)).toBe('a.xacro:3');
  expect(placeOf('', null)).toBe('');
  const busy = new ApiError({ title: '', status: 503, code: 'busy' });
  const texts = [new PackError('bytes', 256 << 20), busy, new Error('Odd.')].map(
    (error) => of(error)[0]?.message,
  );
  expect(texts.at(-1)).toBe('Odd.');
  expect(new Set(texts).size).toBe(3);
});
