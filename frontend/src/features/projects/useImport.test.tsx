import { screen } from '@testing-library/react';
import { beforeEach, describe, expect, it } from 'vitest';
import type { Diagnostic } from '@/api/types';
import { useImportReport } from '@/store/dialogs/importReport';
import { projectDetail } from '@/store/testing';
import { refusal } from '../../../harness/requests';
import { fakeServer, show, user } from '../../../harness/testing';
import { useImport } from './useImport';

const IMPORT = 'POST /projects/import?filename=tree.xml';
const file = new File(['<root/>'], 'tree.xml');

const finding = (code: string): Diagnostic => ({ code, severity: 'error', message: 'A bare &.', line: 3 });

function Page() {
  const { importFile, isImporting, offer, repair, decline } = useImport();
  return (
    <>
      <p>{offer ? `${offer.file.name}: ${offer.changes.length} repairs` : 'no offer'}</p>
      <p>{isImporting ? 'importing' : 'idle'}</p>
      <button onClick={() => importFile(file)}>import</button>
      <button onClick={repair}>repair</button>
      <button onClick={decline}>decline</button>
    </>
  );
}

const answers: Record<string, unknown> = {};
let requests: ReturnType<typeof fakeServer>['requests'];
const click = (name: string) => user.click(screen.getByRole('button', { name }));

beforeEach(() => {
  for (const key of Object.keys(answers)) delete answers[key];
  ({ requests } = fakeServer(answers));
  window.history.pushState(null, '', '/');
  show(<Page />);
});

describe('useImport', () => {
  it('imports a file, and opens the project', async () => {
    answers[IMPORT] = { ...projectDetail(1, []), proposal: { universe: 'line', topics: '/image' } };
    await click('import');
    await expect.poll(() => window.location.pathname).toBe('/projects/p1');
    expect(requests[0]?.body).toBe(file);
    expect(useImportReport.getState()).toMatchObject({ file: 'tree.xml', proposal: { universe: 'line' } });
    expect(screen.getByText('no offer')).toBeInTheDocument();
    expect(screen.getByText('idle')).toBeInTheDocument();
  });

  it('offers to repair a file, and does it on confirmation', async () => {
    answers[IMPORT] = refusal('Not well-formed.', { diagnostics: [finding('BT0740'), finding('BT0740')] });
    answers[`${IMPORT}&repair=true`] = projectDetail(1, []);
    await click('import');
    expect(await screen.findByText('tree.xml: 2 repairs')).toBeInTheDocument();
    expect(screen.queryByText('Not well-formed.')).toBeNull();
    await click('repair');
    expect(screen.getByText('no offer')).toBeInTheDocument();
    await expect.poll(() => window.location.pathname).toBe('/projects/p1');
    expect(requests.at(-1)?.body).toBe(file);
  });

  it('imports nothing if the repair is declined', async () => {
    answers[IMPORT] = refusal('Not well-formed.', { diagnostics: [finding('BT0740')] });
    await click('import');
    await screen.findByText('tree.xml: 1 repairs');
    await click('decline');
    expect(screen.getByText('no offer')).toBeInTheDocument();
    await click('repair');
    expect(requests).toHaveLength(1);
  });

  it.each([
    ['has other faults, too', [finding('BT0740'), finding('BT0101')]],
    ['has none', []],
  ])('reports why a file was refused that %s', async (_, diagnostics) => {
    answers[IMPORT] = refusal('Not a project.', { hint: 'Take a zip.', diagnostics });
    await click('import');
    expect(await screen.findByText('That did not work')).toBeInTheDocument();
    expect(screen.getByText('Not a project. Take a zip.')).toBeInTheDocument();
    expect(screen.getByText('no offer')).toBeInTheDocument();
  });
});
