import { IconAlertTriangle } from '@tabler/icons-react';
import { useTranslation } from 'react-i18next';
import type { DocumentProblem } from '@/model/document/yaml';
import { openFile } from '@/store/project/navigation';
import { select, type UniverseEditor } from './editor';
import classes from './worldEditor.module.css';

interface ProblemListProps {
  readonly problems: readonly DocumentProblem[];
  readonly path: string;
  readonly editor?: UniverseEditor;
}

const SHOWN = 50;

/** What is wrong, each with a way to its line and to its thing. */
export function ProblemList({ problems, path, editor }: ProblemListProps) {
  const { t } = useTranslation('worldEditor');
  if (problems.length === 0) return null;
  const go = ({ line, thing }: DocumentProblem) => {
    if (editor) {
      editor.store.setState({ isTextShown: true });
      if (thing !== null) select(editor, [thing]);
    }
    openFile(path, line);
  };
  return (
    <section className={classes['problems']} aria-label={t('problems', { count: problems.length })}>
      <h3>{t('problems', { count: problems.length })}</h3>
      <ul>
        {problems.slice(0, SHOWN).map((problem, index) => (
          <li key={index}>
            <button type="button" onClick={() => go(problem)}>
              <IconAlertTriangle size={14} aria-hidden="true" />
              <span className={classes['line']}>{t('line', { line: problem.line })}</span>
              <span>
                {problem.path.length > 0 && problem.kind !== 'missing' ? (
                  <code>{problem.path.join('.')}</code>
                ) : null}{' '}
                {t(`problem.${problem.kind}`, problem.params)}
              </span>
            </button>
          </li>
        ))}
      </ul>
    </section>
  );
}
