import { screen } from '@testing-library/react';
import { describe, expect, it } from 'vitest';
import { oneBlock } from '@/store/testing';
import { refusal } from '../../../harness/requests';
import { fakeServer, openProject, show, user } from '../../../harness/testing';
import { FileDifferenceView } from './FileDifferenceView';

const FILES = 'GET /projects/p1/revisions';
const XML = 'POST /trees/xml';
const text = (words: string) => new Response(words);

function open(path: string, before: unknown, after: unknown, more: Readonly<Record<string, unknown>> = {}) {
  fakeServer({ [`${FILES}/2/files/${path}`]: before, [`${FILES}/5/files/${path}`]: after, ...more });
  openProject({});
  show(<FileDifferenceView path={path} sides={[2, 5]} />);
}

const editors = () => screen.getAllByRole('textbox').map(({ textContent }) => textContent);
const choice = (name: string) => screen.getByRole('radio', { name });

describe('a file', () => {
  it('is shown as text', async () => {
    open('actions/Go.py', text('old'), text('new'));
    expect(screen.getByText('Fetching both versions…')).toBeInTheDocument();
    expect(await screen.findByTestId('text-difference')).toBeInTheDocument();
    expect(editors()).toEqual(['old', 'new']);
    expect(screen.queryByRole('radio')).toBeNull();
  });

  it('is empty on the side where it did not exist', async () => {
    open('actions/Go.py', undefined, text('new'));
    expect(await screen.findByTestId('text-difference')).toBeInTheDocument();
    expect(editors()).toEqual(['', 'new']);
  });

  it('that is not text cannot be compared', async () => {
    open('a.png', text('\u0000'), text('\u0000'));
    expect(await screen.findByText(/This file is not text/)).toBeInTheDocument();
    expect(screen.queryByTestId('text-difference')).toBeNull();
  });

  it('reports why it cannot be read', async () => {
    open('a.py', refusal('Not now.', { status: 503 }), text('new'));
    expect(await screen.findByText('The revisions cannot be read: Not now.')).toBeInTheDocument();
  });
});

describe('a tree', () => {
  const path = 'trees/Main.json';
  const [older, newer] = [oneBlock('Main', 'Sequence'), oneBlock('Main', 'Fallback')];

  it('is shown as a picture first', async () => {
    open(path, text(older), text(newer));
    expect(await screen.findByTestId('picture-difference')).toBeInTheDocument();
    expect(choice('Picture')).toBeChecked();
    expect(screen.getByText('1 block differs')).toBeInTheDocument();
    expect(screen.queryByTestId('text-difference')).toBeNull();
  });

  it('is shown as JSON on demand', async () => {
    open(path, text(older), text(newer));
    await screen.findByTestId('picture-difference');
    await user.click(choice('JSON'));
    expect(editors()).toEqual([older, newer]);
    expect(screen.queryByTestId('picture-difference')).toBeNull();
  });

  it('is shown as XML on demand', async () => {
    open(path, text(older), text(newer), { [XML]: { xml: '<Sequence/>', ranges: [] } });
    await screen.findByTestId('picture-difference');
    await user.click(choice('XML'));
    expect(await screen.findByTestId('text-difference')).toBeInTheDocument();
    expect(editors()).toEqual(['<Sequence/>', '<Sequence/>']);
  });

  it('reports why there is no XML', async () => {
    open(path, text(older), text(newer), { [XML]: refusal('The tree is too deep.') });
    await screen.findByTestId('picture-difference');
    await user.click(choice('XML'));
    expect(
      await screen.findByText('The revisions cannot be read: The tree is too deep.'),
    ).toBeInTheDocument();
  });

  it('that did not exist is drawn as new', async () => {
    open(path, undefined, text(newer));
    expect(await screen.findByTestId('picture-difference')).toBeInTheDocument();
    expect(screen.getByRole('list', { name: 'List of differences' })).toHaveTextContent('+Fallback added');
  });

  it('that cannot be read is shown as text only', async () => {
    open(path, text('{'), text(newer));
    expect(await screen.findByTestId('text-difference')).toBeInTheDocument();
    expect(editors()).toEqual(['{', newer]);
    expect(choice('JSON')).toBeChecked();
    expect([choice('Picture'), choice('XML')].map((each) => (each as HTMLInputElement).disabled)).toEqual([
      true,
      true,
    ]);
  });
});
