import { screen, waitFor } from '@testing-library/react';
import { beforeEach, describe, expect, it, vi } from 'vitest';
import { summary } from '../../../harness/requests';
import { fakeServer, show, user } from '../../../harness/testing';
import { NewProject } from './NewProject';

const LIST = 'GET /projects?search=&sort=-updated_at&shelf=current&offset=0&limit=48';
const template = (id: string) => ({
  id,
  name: id,
  description: '',
  universe: '',
  root_diagram: null,
  conditions: [],
});
const onCreate = vi.fn();
const onAttach = vi.fn();
const onImport = vi.fn();

function open(projects: number) {
  const items = Array.from({ length: projects }, (_, i) => summary(`p${i}`));
  fakeServer({
    'GET /catalog/templates': [template('empty'), template('laser_bump_and_go')],
    [LIST]: { items, total: projects, next_offset: null },
  });
  show(
    <NewProject
      onCreate={onCreate}
      pending={null}
      onImport={onImport}
      isImporting={false}
      onAttach={onAttach}
      importButton={{ current: null }}
    />,
  );
}

beforeEach(() => localStorage.clear());

describe('NewProject', () => {
  it('shows templates and examples separately, with placeholders while they load', async () => {
    open(0);
    expect(screen.getByTestId('examples-loading')).toBeInTheDocument();
    expect(await screen.findByTestId('new-from-laser_bump_and_go')).toBeInTheDocument();
    expect(screen.queryByTestId('examples-loading')).toBeNull();
    const headings = screen.getAllByRole('heading', { level: 2 }).map((each) => each.textContent);
    expect(headings).toEqual(['Templates', 'Examples that teach']);
  });

  it('folds them if there are projects; the empty template is one click away', async () => {
    open(1);
    await screen.findByRole('button', { name: 'Empty project' });
    await waitFor(() => expect(screen.queryByTestId('examples-loading')).toBeNull());
    expect(screen.queryByTestId('new-from-laser_bump_and_go')).toBeNull();
    const fold = screen.getByRole('button', { name: 'Templates and examples' });
    expect(fold).toHaveAttribute('aria-expanded', 'false');
    await user.click(screen.getByRole('button', { name: 'Empty project' }));
    expect(onCreate).toHaveBeenCalledExactlyOnceWith('empty');
    await user.click(fold);
    expect(await screen.findByTestId('new-from-laser_bump_and_go')).toBeInTheDocument();
    expect(fold).toHaveAttribute('aria-expanded', 'true');
  });

  it('takes the same file again, since an import may be declined or the file repaired', async () => {
    open(0);
    const field = document.querySelector('input[type="file"]') as HTMLInputElement;
    const file = new File(['zip'], 'robot.zip', { type: 'application/zip' });
    await user.upload(field, file);
    await user.upload(field, file);
    expect(onImport.mock.calls).toEqual([[file], [file]]);
  });

  it('asks for the address of a robot to follow', async () => {
    open(0);
    await user.click(screen.getByTestId('attach'));
    expect(onAttach).toHaveBeenCalledOnce();
  });
});
