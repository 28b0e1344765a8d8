import { screen, waitFor } from '@testing-library/react';
import { beforeEach, describe, expect, it } from 'vitest';
import { refusal, revision } from '../../../harness/requests';
import { fakeServer, openProject, show, user } from '../../../harness/testing';
import { LabelButton } from './LabelButton';

const NAME = 'PATCH /projects/p1/revisions/3';
const button = () => screen.getByRole('button', { name: 'Name revision 3' });
const field = () => screen.getByLabelText('Name of this revision');

beforeEach(() => openProject({}));

describe('LabelButton', () => {
  it('names a revision', async () => {
    const { requests } = fakeServer({ [NAME]: revision(3) });
    show(<LabelButton revision={revision(3, { label: 'old' })} />);
    expect(screen.queryByLabelText('Name of this revision')).toBeNull();
    await user.click(button());
    expect(field()).toHaveValue('old');
    await user.clear(field());
    await user.type(field(), ' works {Enter}');
    await waitFor(() => expect(requests.map(({ body }) => body)).toEqual([{ label: 'works' }]));
    expect(screen.queryByLabelText('Name of this revision')).toBeNull();
  });

  it('drops the typed text when it is closed', async () => {
    const { requests } = fakeServer({});
    show(<LabelButton revision={revision(3)} />);
    await user.click(button());
    await user.type(field(), 'half');
    await user.click(button());
    expect(screen.queryByLabelText('Name of this revision')).toBeNull();
    await user.click(button());
    expect(field()).toHaveValue('');
    expect(requests).toEqual([]);
  });

  it('reports why a name was refused', async () => {
    fakeServer({ [NAME]: refusal('The name is taken.') });
    show(<LabelButton revision={revision(3)} />);
    await user.click(button());
    await user.type(field(), 'works');
    await user.click(screen.getByRole('button', { name: 'Keep' }));
    expect(await screen.findByText('The name could not be saved')).toBeInTheDocument();
    expect(screen.getByText('The name is taken.')).toBeInTheDocument();
  });
});
