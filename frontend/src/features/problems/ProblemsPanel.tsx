import { ScrollArea, Text } from '@mantine/core';
import { IconAlertTriangle, IconCircleCheck, IconCircleX, IconInfoCircle } from '@tabler/icons-react';
import { useMemo } from 'react';
import { useTranslation } from 'react-i18next';
import type { Diagnostic, Severity } from '@/api/types';
import { displayName } from '@/model/diagram';
import { useProjectStore } from '@/store/project';
import { fixesOfDiagnostic } from '@/store/project/edits/fixes';
import { openFile, openTree } from '@/store/project/navigation';
import { inOwnWords } from '@/store/project/problems';
import { QuickFixes } from '@/ui/QuickFixes';
import { useProblemText } from '@/ui/useProblemText';
import classes from './problems.module.css';

const ORDER: Severity[] = ['error', 'warning', 'note'];
const ICONS = { error: IconCircleX, warning: IconAlertTriangle, note: IconInfoCircle };

/** Shows the place of a finding. */
function go(item: Diagnostic): void {
  if (item.tree && item.node) {
    openTree(item.tree);
    useProjectStore.getState().reveal(item.tree, item.node);
  } else if (item.file) {
    openFile(item.file, item.line ?? undefined);
  } else if (item.tree) {
    openTree(item.tree);
  }
}

export function ProblemsPanel() {
  const { t } = useTranslation('problems');
  const diagnostics = useProjectStore((state) => state.diagnostics);
  const sorted = useMemo(
    () => [...diagnostics].sort((a, b) => ORDER.indexOf(a.severity) - ORDER.indexOf(b.severity)),
    [diagnostics],
  );
  return (
    <ScrollArea h="100%" type="auto" data-testid="problems">
      {sorted.length === 0 ? (
        <div className={classes['none']}>
          <IconCircleCheck size={18} aria-hidden="true" />
          <Text size="sm">{t('none')}</Text>
        </div>
      ) : (
        <ul className={classes['list']} aria-label={t('label')}>
          {sorted.map((item, index) => (
            <li key={`${item.code}-${index}`}>
              <Row item={item} />
            </li>
          ))}
        </ul>
      )}
    </ScrollArea>
  );
}

function Row({ item }: { readonly item: Diagnostic }) {
  const { t } = useTranslation('problems');
  const diagram = useProjectStore((state) => (item.tree ? state.diagrams[item.tree] : undefined));
  const vocabulary = useProjectStore((state) => state.vocabulary);
  const { message, hint } = useProblemText()(inOwnWords(item, diagram, vocabulary));
  const node = item.node ? diagram?.nodes[item.node] : undefined;
  const Icon = ICONS[item.severity];
  const place = item.file ? [item.file, item.line].filter(Boolean).join(':') : (item.tree ?? '');
  const where = [node ? displayName(node) : '', item.port ? t('port', { port: item.port }) : '', place]
    .filter(Boolean)
    .join(' · ');
  const fixes = node ? fixesOfDiagnostic(item) : [];
  return (
    <>
      <button
        type="button"
        className={classes['row']}
        data-severity={item.severity}
        data-code={item.code}
        onClick={() => go(item)}
      >
        <Icon size={16} role="img" aria-label={t(`severity.${item.severity}`)} />
        <span className={classes['text']}>
          {message} {hint ? <span className={classes['hint']}>{hint}</span> : null}
        </span>
        <span className={classes['where']}>{where}</span>
        <span className={classes['code']}>{item.code}</span>
      </button>
      {fixes.length > 0 ? (
        <div className={classes['fixes']}>
          <QuickFixes tree={item.tree ?? ''} fixes={fixes} />
        </div>
      ) : null}
    </>
  );
}
