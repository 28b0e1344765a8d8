import { useEffect, useMemo, useRef, useState } from 'react';
import { useShallow } from 'zustand/react/shallow';
import type { Passage } from '@/model/search/passages';
import { useProjectStore } from '@/store/project';
import { allPassages } from '@/store/project/edits/replace';
import { resultsOf, type Results } from './results';
import { SearchRunner, type Outcome } from './runner';
import { useSearchStore } from './searchStore';

export type SearchState =
  | { readonly kind: 'idle' | 'searching' | 'too-slow' }
  | { readonly kind: 'wrong'; readonly reason: string }
  | { readonly kind: 'found'; readonly results: Results };

const SETTLED_MS = 150;

export interface Search {
  readonly state: SearchState;
  /** Whether the state belongs to the current query, replacement and project. */
  readonly isFresh: boolean;
}

/** Returns the hits in the current project; the search is repeated shortly after each edit. */
export function useSearch(): Search {
  const { files, diagrams } = useProjectStore(
    useShallow((state) => ({ files: state.files, diagrams: state.diagrams })),
  );
  const query = useSearchStore(
    useShallow(({ text, matchesCase, isWholeWord, isRegex }) => ({
      text,
      matchesCase,
      isWholeWord,
      isRegex,
    })),
  );
  const replacement = useSearchStore((state) => (state.isReplacing ? state.replacement : null));
  const runner = useRef<SearchRunner | null>(null);
  const passages = useMemo(() => allPassages({ files, diagrams }), [files, diagrams]);
  const request = useMemo(
    () => ({ query, replacement, texts: passages.map(({ text }) => text) }),
    [query, replacement, passages],
  );
  const [found, setFound] = useState<{ state: SearchState; request: object | null }>({
    state: { kind: 'searching' },
    request: null,
  });

  useEffect(
    () => () => {
      runner.current?.end();
      runner.current = null;
    },
    [],
  );
  useEffect(() => {
    if (request.query.text === '') return;
    const timer = setTimeout(() => {
      runner.current ??= new SearchRunner();
      void runner.current.run(request).then((outcome) => {
        if (outcome !== 'replaced') setFound({ state: stateOf(outcome, passages), request });
      });
    }, SETTLED_MS);
    return () => clearTimeout(timer);
  }, [request, passages]);

  return query.text === '' ? IDLE : { state: found.state, isFresh: found.request === request };
}

const IDLE: Search = { state: { kind: 'idle' }, isFresh: true };

function stateOf(outcome: Exclude<Outcome, 'replaced'>, passages: readonly Passage[]): SearchState {
  if (outcome === 'too-slow') return { kind: 'too-slow' };
  if ('wrong' in outcome) return { kind: 'wrong', reason: outcome.wrong };
  return { kind: 'found', results: resultsOf(passages, outcome) };
}
