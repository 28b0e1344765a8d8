import { Button, ScrollArea, Text } from '@mantine/core';
import { notifications } from '@mantine/notifications';
import {
  IconAlertTriangle,
  IconCircleCheck,
  IconCircleX,
  IconHistory,
  IconInfoCircle,
} from '@tabler/icons-react';
import { useTranslation } from 'react-i18next';
import { displayName } from '@/model/diagram';
import { fileFixes, fixesFor, type Fix } from '@/model/fixes';
import { goToFault } from '@/store/moment/looking';
import { useExtent } from '@/store/moment/useExtent';
import { useProjectStore } from '@/store/project';
import type { ListedProblem } from '@/store/problems/list';
import { openProblem } from '@/store/problems/open';
import { useProblems } from '@/store/problems/useProblems';
import { FindingMenu } from '@/ui/FindingMenu';
import { QuickFixes } from '@/ui/QuickFixes';
import { ReasonPath } from '@/ui/ReasonPath';
import { useProblemText } from '@/ui/hooks/useProblemText';
import classes from './problems.module.css';

const TREE_FILE = /^trees\/(.+)\.json$/;
const ICONS = { error: IconCircleX, warning: IconAlertTriangle, note: IconInfoCircle };

export function ProblemsPanel() {
  const { t } = useTranslation('problems');
  const rows = useProblems();
  return (
    <ScrollArea h="100%" type="auto" data-testid="problems">
      {rows.length === 0 ? (
        <div className={classes['none']}>
          <IconCircleCheck size={18} aria-hidden="true" />
          <Text size="sm">{t('none')}</Text>
        </div>
      ) : (
        <ul className={classes['list']} aria-label={t('label')}>
          {rows.map((item, index) => (
            <li key={`${item.code}-${index}`}>
              <Row item={item} />
            </li>
          ))}
        </ul>
      )}
    </ScrollArea>
  );
}

function Row({ item }: { readonly item: ListedProblem }) {
  const { t } = useTranslation('problems');
  const diagram = useProjectStore((state) => (item.tree ? state.diagrams[item.tree] : undefined));
  const vocabulary = useProjectStore((state) => state.vocabulary);
  const { message, hint } = useProblemText()(item.problem);
  const node = item.node ? diagram?.nodes[item.node] : undefined;
  const Icon = ICONS[item.severity];
  // The user knows a tree by its name, not by its file.
  const file = item.file?.replace(TREE_FILE, '$1');
  const place = file ? [file, item.line].filter(Boolean).join(':') : (item.tree ?? '');
  const where = [
    item.topic ?? '',
    node ? displayName(node) : '',
    item.port ? t('port', { port: item.port }) : '',
    place,
  ]
    .filter(Boolean)
    .join(' · ');
  const fixes = diagram && !item.isFault ? fixesFor(item.problem, diagram, vocabulary) : fixesOfFile(item);
  const path = item.problem.source === 'server' ? (item.problem.path ?? []) : [];
  const hasMoment = useExtent() !== null && item.isFault;
  const canSilence = node !== undefined && item.severity !== 'error' && !item.isFault;
  return (
    <>
      <button
        type="button"
        className={classes['row']}
        data-severity={item.severity}
        data-code={item.code}
        // The list of all findings has them by their codes.
        title={item.code}
        onClick={() => openProblem(item)}
      >
        <Icon size={16} role="img" aria-label={t(`severity.${item.severity}`)} />
        <span className={classes['text']}>
          {message} {hint ? <span className={classes['hint']}>{hint}</span> : null}
        </span>
        <span className={classes['where']}>{where}</span>
        {item.isFault || item.topic !== null ? (
          <span className={classes['fault']}>{t(item.isFault ? 'fault' : 'topic')}</span>
        ) : null}
      </button>
      {path.length > 0 || fixes.length > 0 || canSilence || hasMoment ? (
        <div className={classes['fixes']}>
          <ReasonPath path={path} />
          <div className={classes['actions']}>
            <QuickFixes tree={item.tree ?? ''} fixes={fixes} />
            {hasMoment ? (
              <MomentButton message={item.problem.source === 'server' ? item.problem.message : ''} />
            ) : null}
            {canSilence ? (
              <FindingMenu tree={item.tree ?? ''} node={item.node ?? ''} code={item.code} message={message} />
            ) : null}
          </div>
        </div>
      ) : null}
    </>
  );
}

function fixesOfFile({ file, line, problem }: ListedProblem): Fix[] {
  if (file === null || problem.source !== 'server') return [];
  return fileFixes(problem.code, file, line, problem.values);
}

/** Goes to the moment at which a fault of the run happened. */
function MomentButton({ message }: { readonly message: string }) {
  const { t } = useTranslation('problems');
  const go = async () => {
    const isFound = await goToFault(message).catch(() => false);
    if (!isFound) notifications.show({ message: t('moment.missing') });
  };
  return (
    <Button
      size="compact-xs"
      variant="default"
      leftSection={<IconHistory size={14} />}
      data-testid="fault-moment"
      onClick={() => void go()}
    >
      {t('moment.show')}
    </Button>
  );
}
