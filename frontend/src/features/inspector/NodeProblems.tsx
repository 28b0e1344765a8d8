import { IconAlertTriangle, IconInfoCircle } from '@tabler/icons-react';
import { useMemo } from 'react';
import type { Diagram, NodeId } from '@/model/diagram';
import { fixesFor } from '@/model/fixes';
import { CODES } from '@/model/problems';
import { liveKey } from '@/store/project/live';
import { useShownLive } from '@/store/moment/store';
import { problemsOf } from '@/store/project/problems';
import { useProjectStore } from '@/store/project';
import { FindingMenu } from '@/ui/FindingMenu';
import { QuickFixes } from '@/ui/QuickFixes';
import { ReasonPath } from '@/ui/ReasonPath';
import { FaultOfRun } from './FaultOfRun';
import { useProblemText } from '@/ui/hooks/useProblemText';
import classes from './Inspector.module.css';

interface NodeProblemsProps {
  readonly diagram: Diagram;
  readonly id: NodeId;
  readonly onFixed?: () => void;
}

/** The list of the block's problems with their fixes; the fault of the last run comes first. */
export function NodeProblems({ diagram, id, onFixed }: NodeProblemsProps) {
  const vocabulary = useProjectStore((state) => state.vocabulary);
  const diagnostics = useProjectStore((state) => state.diagnostics);
  const textOf = useProblemText();
  const problems = useMemo(
    () => problemsOf(diagram, vocabulary, diagnostics).filter((each) => each.node === id),
    [diagram, vocabulary, diagnostics, id],
  );
  const fault = useShownLive((state) => state.faults.get(liveKey(diagram.id, id)));
  if (problems.length === 0 && fault === undefined) return null;
  return (
    <ul className={classes['problems']}>
      {fault === undefined ? null : <FaultOfRun tree={diagram.id} id={id} message={fault} />}
      {problems.map((problem, index) => {
        const { message, hint } = textOf(problem);
        const code = problem.source === 'editor' ? (CODES[problem.kind][0] ?? '') : problem.code;
        const Mark = problem.severity === 'note' ? IconInfoCircle : IconAlertTriangle;
        return (
          <li key={index} className={classes['problem']} data-severity={problem.severity}>
            <Mark size={16} aria-hidden="true" />
            <span>
              <strong>{message}</strong> {hint}
              {problem.source === 'server' ? <ReasonPath path={problem.path ?? []} /> : null}
              <QuickFixes tree={diagram.id} fixes={fixesFor(problem, diagram, vocabulary)} onDone={onFixed} />
            </span>
            <span>
              {code !== '' && problem.severity !== 'error' ? (
                <FindingMenu tree={diagram.id} node={id} code={code} message={message} />
              ) : null}
            </span>
          </li>
        );
      })}
    </ul>
  );
}
