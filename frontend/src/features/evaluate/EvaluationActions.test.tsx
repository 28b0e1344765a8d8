import { screen } from '@testing-library/react';
import { expect, it, vi } from 'vitest';
import '@/i18n/editorTexts';
import type { Evaluation } from '@/api/evaluations';
import { evaluation } from '../../../harness/evaluations';
import { fakeServer, show, user } from '../../../harness/testing';
import { EvaluationActions } from './EvaluationActions';

function open(found: Evaluation, mayStart = true) {
  const did = { onCancel: vi.fn(), onResume: vi.fn(), onCompare: vi.fn(), onRemove: vi.fn() };
  fakeServer({});
  show(<EvaluationActions projectId="p1" evaluation={found} earlier={null} mayStart={mayStart} {...did} />);
  return did;
}
const named = (name: string) => screen.queryByRole('button', { name });

it('cancels what runs', async () => {
  const did = open(evaluation());
  expect(named('Run the rest')).toBeNull();
  await user.click(named('Cancel')!);
  expect(did.onCancel).toHaveBeenCalled();
});

it('resumes what was cancelled, and what has runs that do not count', async () => {
  const did = open(evaluation({ state: 'cancelled' }));
  await user.click(named('Run the rest')!);
  expect(did.onResume).toHaveBeenCalled();
});

it('deletes after a question', async () => {
  const did = open(evaluation({ state: 'done' }));
  await user.click(named('More about this evaluation')!);
  await user.click(await screen.findByRole('menuitem', { name: 'Delete' }));
  expect(did.onRemove).not.toHaveBeenCalled();
  await user.click(named('Delete')!);
  expect(did.onRemove).toHaveBeenCalled();
});

it('gives the report and the lines as files, to viewers too', async () => {
  open(evaluation({ state: 'done' }), false);
  expect(screen.getByRole('link', { name: 'Download the report' })).toHaveAttribute(
    'href',
    expect.stringContaining('/projects/p1/evaluations/e1/report.html'),
  );
  expect(named('Compare…')).toBeNull();
  await user.click(named('More about this evaluation')!);
  expect(await screen.findByRole('menuitem', { name: 'runs.jsonl of revision 7' })).toBeInTheDocument();
  expect(screen.queryByRole('menuitem', { name: 'Delete' })).toBeNull();
});
