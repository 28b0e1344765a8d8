import { readFileSync } from 'node:fs';
import i18next from 'i18next';
import { afterEach, expect, it } from 'vitest';
import { ApiError } from '@/api/errors';
import { linesText, reasonText, refusalText } from './evaluationReasons';
import './editorTexts';

const t = i18next.getFixedT(null, 'evaluate');
const { sentences } = JSON.parse(readFileSync('../tests/shared/reasons.json', 'utf-8')) as {
  readonly sentences: readonly { readonly sentence: string }[];
};
const refusal = (code: string) =>
  new ApiError({ title: 'No', status: 409, code, detail: 'What the server says.', hint: 'Do this.' });

afterEach(() => i18next.changeLanguage('en'));

it('says what an evaluation says in the language of the page', async () => {
  expect(reasonText(t, 'reach door: the time is over')).toBe('reach door: the time is over');
  await i18next.changeLanguage('es');
  expect(reasonText(t, 'reach door: the time is over')).toBe('llegar a door: se acabó el tiempo');
  expect(linesText(t, 'Some runs came to no outcome.\nactions/Go.py:3:1: no')).toBe(
    'Algunas ejecuciones no llegaron a ningún resultado.\nactions/Go.py:3:1: no',
  );
});

it('has a Spanish text for each sentence that has words of its own', async () => {
  await i18next.changeLanguage('es');
  for (const { sentence } of sentences.filter((each) => !each.sentence.startsWith('python ')))
    expect(reasonText(t, sentence)).not.toBe(sentence);
});

it('says in words how a process ended', () => {
  for (const { sentence } of sentences) expect(reasonText(t, sentence)).not.toMatch(/SIG[A-Z]/);
  expect(reasonText(t, 'the process of the run ended with SIGSEGV in actions/Go.py:12')).toBe(
    'the process of the run crashed in actions/Go.py:12',
  );
});

it('says why the server refused, and otherwise what it says with its hint', async () => {
  expect(refusalText(t, refusal('revision_not_older'))).toContain('Choose an older one');
  expect(refusalText(t, refusal('something_new'))).toBe('What the server says. Do this.');
  await i18next.changeLanguage('es');
  expect(refusalText(t, refusal('evaluation_runs'))).toContain('ya está en marcha');
  expect(refusalText(t, new Error('gone'))).toBe('gone');
});
