import { Kbd } from '@mantine/core';
import { Spotlight, type SpotlightActionData } from '@mantine/spotlight';
import { IconFileCode, IconGitFork, IconSearch } from '@tabler/icons-react';
import { useMemo } from 'react';
import { useTranslation } from 'react-i18next';
import { useActionTable, type ActionGroup } from '@/actions/registry';
import { shortcutLabel } from '@/actions/shortcuts';
import { useProjectStore } from '@/store/project';
import { openTab } from './tabs';

/** What is wanted most often comes first. */
const GROUPS: ActionGroup[] = ['run', 'project', 'canvas', 'edit', 'view', 'go'];

/** Everything that can be done, and every file, by name. */
export function CommandPalette() {
  const { t } = useTranslation('frame');
  const table = useActionTable((state) => state.actions);
  const files = useProjectStore((state) => state.files);
  const diagrams = useProjectStore((state) => state.diagrams);

  const actions = useMemo(() => {
    const commands = Object.values(table)
      .filter((action) => !action.hidden)
      .sort((a, b) => GROUPS.indexOf(a.group) - GROUPS.indexOf(b.group))
      .map((action): SpotlightActionData => {
        const Icon = action.icon;
        return {
          id: action.id,
          label: t(action.labelKey),
          onClick: () => {
            if (action.enabled?.() !== false) action.run();
          },
          ...(Icon ? { leftSection: <Icon size={18} /> } : {}),
          ...(action.shortcut ? { rightSection: <Kbd size="xs">{shortcutLabel(action.shortcut)}</Kbd> } : {}),
        };
      });
    const documents: SpotlightActionData[] = [
      ...Object.keys(diagrams).map((id) => ({
        id: `tree:${id}`,
        label: t('palette.openTree', { name: id }),
        leftSection: <IconGitFork size={18} />,
        onClick: () => openTab({ kind: 'tree', id }),
      })),
      ...Object.values(files)
        .filter((file) => file.kind === 'text')
        .map(({ path }) => ({
          id: `file:${path}`,
          label: t('palette.openFile', { name: path }),
          leftSection: <IconFileCode size={18} />,
          onClick: () => openTab({ kind: 'file', path }),
        })),
    ];
    return [...commands, ...documents];
  }, [table, files, diagrams, t]);

  return (
    <Spotlight
      actions={actions}
      shortcut={null}
      nothingFound={t('palette.nothing')}
      highlightQuery
      scrollable
      maxHeight={420}
      attributes={{ content: { 'aria-label': t('palette.placeholder') } }}
      searchProps={{
        leftSection: <IconSearch size={18} />,
        placeholder: t('palette.placeholder'),
        'aria-label': t('palette.placeholder'),
      }}
    />
  );
}
