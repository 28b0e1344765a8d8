import { useShallow } from 'zustand/react/shallow';
import { useLanguageStore } from '@/store/language';
import { useProjectStore } from '@/store/project';
import { useSessionStore } from '@/store/session/store';
import { listProblems, type ListedProblem, type ProblemSources } from './list';
import { useLookedAt } from './robots';
import { useTextFindings } from './texts';

let last: { readonly sources: ProblemSources; readonly rows: readonly ListedProblem[] } | null = null;

/** Returns the list of these sources. It is cached, since several parts of the page show it. */
function rowsOf(sources: ProblemSources): readonly ListedProblem[] {
  const before = last?.sources;
  const isSame =
    before !== undefined &&
    (Object.keys(sources) as (keyof ProblemSources)[]).every((key) => before[key] === sources[key]);
  if (last === null || !isSame) last = { sources, rows: listProblems(sources) };
  return last.rows;
}

/**
 * Returns all findings of the project; the Problems panel, its count, and the marks in the Explorer show the
 * same list.
 */
export function useProblems(): readonly ListedProblem[] {
  const project = useProjectStore(
    useShallow(({ files, diagrams, vocabulary, diagnostics }) => ({
      files,
      diagrams,
      vocabulary,
      diagnostics,
    })),
  );
  const robots = useLookedAt();
  const served = useLanguageStore((state) => state.findings);
  const { linted, errors } = useTextFindings();
  const run = useSessionStore(
    useShallow(({ faults, mismatches, launchNodes }) => ({ faults, mismatches, launchNodes })),
  );
  return rowsOf({ ...project, robots, served, linted, errors, ...run });
}
