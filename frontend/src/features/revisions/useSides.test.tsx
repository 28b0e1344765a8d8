import { screen } from '@testing-library/react';
import { describe, expect, it } from 'vitest';
import { refusal } from '../../../harness/requests';
import { fakeServer, openProject, show } from '../../../harness/testing';
import { oneBlock } from '@/store/testing';
import { diagramOf, useDifferences, useFileSides, useXmlSides } from './useSides';

const FILE = 'GET /projects/p1/revisions';
const text = (words: string) => new Response(words);

function open(answers: Record<string, unknown>) {
  const { requests } = fakeServer(answers);
  openProject({});
  return () => requests.map(({ method, path }) => `${method} ${path}`);
}

describe('diagramOf', () => {
  it('reads a diagram, under the name of its file', () => {
    expect(diagramOf(oneBlock('Other', 'Sequence'), 'Main')).toMatchObject({
      id: 'Main',
      root: 'n1',
      nodes: { n1: { type: 'Sequence' } },
    });
  });

  it('is empty if there was no file, and null if it cannot be read', () => {
    expect(diagramOf(null, 'Main')).toMatchObject({ id: 'Main', root: null, nodes: {}, drafts: [] });
    expect(diagramOf('{', 'Main')).toBeNull();
  });
});

describe('useDifferences', () => {
  function Files() {
    return (
      <p>
        {useDifferences([2, 5])
          .data?.map(({ path }) => path)
          .join(' ')}
      </p>
    );
  }

  it('requests the newer revision compared with the older', async () => {
    const asked = open({ [`${FILE}/5/diff?against=2`]: { files: [{ path: 'a.py' }, { path: 'b.py' }] } });
    show(<Files />);
    expect(await screen.findByText('a.py b.py')).toBeInTheDocument();
    expect(asked()).toEqual([`${FILE}/5/diff?against=2`]);
  });
});

describe('useFileSides', () => {
  function Sides({ path, older = 2 }: { readonly path: string | null; readonly older?: number }) {
    const { data, error } = useFileSides(path, [older, 5]);
    if (error) return <p>{error.message}</p>;
    return <p>{data ? `${String(data.before)} | ${String(data.after)}` : 'waiting'}</p>;
  }

  it('fetches both states of a file', async () => {
    open({ [`${FILE}/2/files/actions/Go.py`]: text('old'), [`${FILE}/5/files/actions/Go.py`]: text('new') });
    show(<Sides path="actions/Go.py" />);
    expect(await screen.findByText('old | new')).toBeInTheDocument();
  });

  it('has no text where the file did not exist, or is not text', async () => {
    const asked = open({ [`${FILE}/5/files/a.png`]: text('\u0000') });
    show(<Sides path="a.png" older={0} />);
    expect(await screen.findByText('null | null')).toBeInTheDocument();
    expect(asked()).toEqual([`${FILE}/5/diff?against=0`, `${FILE}/5/files/a.png`]);
  });

  it('does not request a file from a revision without it', async () => {
    const diff = `${FILE}/5/diff?against=2`;
    const asked = open({
      [diff]: {
        files: [
          { path: 'new.py', change: 'added' },
          { path: 'old.py', change: 'removed' },
        ],
      },
      [`${FILE}/5/files/new.py`]: text('new'),
      [`${FILE}/2/files/old.py`]: text('old'),
    });
    show(<Sides path="new.py" />);
    expect(await screen.findByText('null | new')).toBeInTheDocument();
    show(<Sides path="old.py" />);
    expect(await screen.findByText('old | null')).toBeInTheDocument();
    expect(asked()).toEqual([diff, `${FILE}/5/files/new.py`, `${FILE}/2/files/old.py`]);
  });

  it('passes an error on', async () => {
    open({ [`${FILE}/2/files/a`]: refusal('Not now.', { status: 503 }), [`${FILE}/5/files/a`]: text('x') });
    show(<Sides path="a" />);
    expect(await screen.findByText('Not now.')).toBeInTheDocument();
  });

  it('waits for a path', () => {
    const asked = open({});
    show(<Sides path={null} />);
    expect(screen.getByText('waiting')).toBeInTheDocument();
    expect(asked()).toEqual([]);
  });
});

describe('useXmlSides', () => {
  const WRITE = 'POST /trees/xml';
  const tree = diagramOf(oneBlock('Main', 'Sequence'), 'Main');
  const empty = diagramOf(null, 'Main');

  function Xml({ hasBefore, hasAfter }: { readonly hasBefore: boolean; readonly hasAfter: boolean }) {
    const { data } = useXmlSides(hasBefore ? tree : empty, hasAfter ? tree : null, [2, 5]);
    return <p>{data ? `[${data.before}] [${data.after}]` : 'waiting'}</p>;
  }

  it('writes both trees as XML', async () => {
    const { requests } = fakeServer({ [WRITE]: { xml: '<Sequence/>', ranges: [] } });
    show(<Xml hasBefore hasAfter />);
    expect(await screen.findByText('[<Sequence/>] [<Sequence/>]')).toBeInTheDocument();
    expect(JSON.parse((requests[0]?.body as { diagram: string }).diagram)).toMatchObject({ id: 'Main' });
  });

  it('has no text where the tree did not exist', async () => {
    const { requests } = fakeServer({ [WRITE]: { xml: '<Sequence/>', ranges: [] } });
    show(<Xml hasBefore={false} hasAfter={false} />);
    expect(await screen.findByText('[] []')).toBeInTheDocument();
    expect(requests).toEqual([]);
  });
});
