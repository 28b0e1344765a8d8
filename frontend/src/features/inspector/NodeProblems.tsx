import { IconAlertTriangle, IconInfoCircle } from '@tabler/icons-react';
import { useMemo } from 'react';
import type { Diagram, NodeId } from '@/model/diagram';
import { fixesFor } from '@/model/fixes';
import { problemsOf } from '@/store/project/problems';
import { useProjectStore } from '@/store/project';
import { QuickFixes } from '@/ui/QuickFixes';
import { useProblemText } from '@/ui/useProblemText';
import classes from './Inspector.module.css';

interface NodeProblemsProps {
  readonly diagram: Diagram;
  readonly id: NodeId;
  readonly onFixed?: () => void;
}

/** What is wrong with the block and what to do, above its fields. */
export function NodeProblems({ diagram, id, onFixed }: NodeProblemsProps) {
  const vocabulary = useProjectStore((state) => state.vocabulary);
  const diagnostics = useProjectStore((state) => state.diagnostics);
  const textOf = useProblemText();
  const problems = useMemo(
    () => problemsOf(diagram, vocabulary, diagnostics).filter((each) => each.node === id),
    [diagram, vocabulary, diagnostics, id],
  );
  if (problems.length === 0) return null;
  return (
    <ul className={classes['problems']}>
      {problems.map((problem, index) => {
        const { message, hint } = textOf(problem);
        const Mark = problem.severity === 'note' ? IconInfoCircle : IconAlertTriangle;
        return (
          <li key={index} className={classes['problem']} data-severity={problem.severity}>
            <Mark size={16} aria-hidden="true" />
            <span>
              <strong>{message}</strong> {hint}
              <QuickFixes tree={diagram.id} fixes={fixesFor(problem, diagram, vocabulary)} onDone={onFixed} />
            </span>
          </li>
        );
      })}
    </ul>
  );
}
