import { describe, expect, it } from 'vitest';
import '@/i18n/editorTexts';
import i18next from 'i18next';
import { translates } from '@/i18n';
import type { TreeNode } from '@/generated/messages';
import { REASONS, yes } from '@/model/why/verdict';
import { nameOf, question, sentence, statusOf } from './sentence';

const t = i18next.getFixedT('en', 'why');
const node = (uid: number, name: string, type = name): TreeNode => ({
  ...{ uid, parent: 0, type, name, kind: '', path: name, node_id: '', tree_id: '' },
});
const nodes = [node(1, 'main'), node(2, 'keep clear'), node(3, 'Forward::3', 'Forward')];

describe('the words for a reason', () => {
  it('there is a sentence for each reason, whose places are all filled', () => {
    for (const code of REASONS) {
      expect(translates(`why:reason.${code}`), code).toBe(true);
      expect(sentence(t, nodes, { code, by: 2, status: 'SUCCESS' }, 3, 1)).not.toMatch(/[{}]/);
    }
  });

  it('name the nodes as the canvas does', () => {
    expect(sentence(t, nodes, { code: 'after', by: 2, status: 'SUCCESS' }, 3, 1)).toBe(
      '“keep clear” returned SUCCESS, so “Forward” is ticked.',
    );
    expect(nameOf(undefined)).toBe('');
  });

  it('name the conditions that can have decided', () => {
    const reason = { code: 'condition', status: 'SKIPPED' } as const;
    expect(sentence(t, nodes, { ...reason, conditions: ['_skipIf', '_while'] }, 3, 1)).toContain(
      '_skipIf or _while of “main”',
    );
    expect(sentence(t, nodes, { ...reason, conditions: [] }, 3, 1)).toContain('A pre-condition of “main”');
  });
});

it('the question follows from the verdict', () => {
  const no = { ticked: 'no', result: null, reason: { code: 'passed' } } as const;
  expect(question(t, yes('RUNNING', { code: 'first' }))).toBe('Why is it RUNNING?');
  expect(question(t, yes(null, { code: 'first' }))).toBe('Why was it ticked?');
  expect(question(t, no)).toBe('Why was it not ticked?');
  expect(question(t, null)).toBe('Was it ticked?');
  expect([
    statusOf(no),
    statusOf(yes(null, { code: 'own' })),
    statusOf(yes('FAILURE', { code: 'own' })),
  ]).toEqual(['notTicked', 'unknown', 'FAILURE']);
});
