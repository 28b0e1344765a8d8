import { ActionIcon, ScrollArea, Tooltip } from '@mantine/core';
import { IconPlus } from '@tabler/icons-react';
import { useMemo } from 'react';
import { useTranslation } from 'react-i18next';
import { openNewFile, type NewFileKind } from '@/store/dialogs/files';
import { openNewRobot, ROBOT_FILE } from '@/store/dialogs/newRobot';
import { openNewUniverse, UNIVERSE_FILE } from '@/store/dialogs/newUniverse';
import { useShallow } from 'zustand/react/shallow';
import { worstByFile } from '@/store/problems/list';
import { useProblems } from '@/store/problems/useProblems';
import { useProjectStore } from '@/store/project';
import { ExplorerItem } from './ExplorerItem';
import classes from './explorer.module.css';
import { UsedSection } from './used/UsedSection';

type Section = 'trees' | 'actions' | 'universes' | 'robots' | 'others';

type NewKind = NewFileKind | 'universe' | 'robot';

const NEW_KIND: Record<Section, NewKind> = {
  trees: 'tree',
  actions: 'action',
  universes: 'universe',
  robots: 'robot',
  others: 'file',
};

function openNew(kind: NewKind): void {
  if (kind === 'universe') openNewUniverse();
  else if (kind === 'robot') openNewRobot();
  else openNewFile(kind);
}

function sectionOf(path: string): Section {
  if (/^trees\/[^/]+\.json$/.test(path)) return 'trees';
  if (UNIVERSE_FILE.test(path)) return 'universes';
  if (ROBOT_FILE.test(path)) return 'robots';
  return /^actions\/[^/]+\.py$/.test(path) ? 'actions' : 'others';
}

/** The list of the project's files, grouped by kind. */
export function Explorer() {
  const { t } = useTranslation('frame');
  const files = useProjectStore(useShallow((state) => Object.keys(state.files)));
  const problems = useProblems();
  const worst = useMemo(() => worstByFile(problems), [problems]);
  const sections = useMemo(() => {
    const found: Record<Section, string[]> = {
      trees: [],
      actions: [],
      universes: [],
      robots: [],
      others: [],
    };
    for (const path of [...files].sort()) found[sectionOf(path)].push(path);
    return found;
  }, [files]);

  return (
    <ScrollArea h="100%" type="auto" scrollbarSize={8}>
      <nav className={classes['explorer']} aria-label={t('panel.explorer')}>
        <UsedSection />
        {(Object.keys(sections) as Section[]).map((section) => {
          const kind = NEW_KIND[section];
          return (
            <section key={section} aria-labelledby={`explorer-${section}`}>
              <div className={classes['heading']}>
                <h2 id={`explorer-${section}`}>{t(`explorer.${section}`)}</h2>
                <Tooltip label={t(`explorer.new.${kind}`)}>
                  <ActionIcon
                    size="sm"
                    aria-label={t(`explorer.new.${kind}`)}
                    data-testid={`new-${kind}`}
                    onClick={() => openNew(kind)}
                  >
                    <IconPlus size={15} />
                  </ActionIcon>
                </Tooltip>
              </div>
              <ul className={classes['list']}>
                {sections[section].map((path) => (
                  <li key={path}>
                    <ExplorerItem
                      path={path}
                      isTree={section === 'trees'}
                      isAction={section === 'actions'}
                      worst={worst.get(path)}
                    />
                  </li>
                ))}
              </ul>
            </section>
          );
        })}
      </nav>
    </ScrollArea>
  );
}
