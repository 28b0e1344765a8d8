import { Kbd, Modal, Table, Title } from '@mantine/core';
import { useTranslation } from 'react-i18next';
import { useCommandTable, type CommandGroup } from '@/commands/registry';
import { keysOf, shortcutLabel } from '@/commands/shortcuts';
import classes from './onboarding.module.css';
import { closeShortcuts, useShortcutsDialog } from '@/store/dialogs/shortcuts';

const GROUPS: readonly CommandGroup[] = ['run', 'edit', 'canvas', 'project', 'view', 'go'];

/** The keys of the canvas that are not in the command table; their texts are `key.<id>`. */
const CANVAS_KEYS: readonly (readonly [id: string, keys: string])[] = [
  ['walk', '← ↑ → ↓'],
  ['move', '$mod+← ↑ → ↓'],
  ['unwrap', 'Shift+Delete'],
  ['root', 'Home'],
  ['menu', 'Shift+F10'],
];

/** The list of all shortcuts. It is read from the command table, so that none is missing. */
export function Shortcuts() {
  const { t } = useTranslation('onboarding');
  const isOpen = useShortcutsDialog((state) => state.isOpen);
  const commands = useCommandTable((state) => state.commands);
  const rowsOf = (group: CommandGroup) =>
    Object.values(commands)
      .filter((command) => command.group === group && keysOf(command) !== null)
      .map((command) => ({ id: command.id, label: t(command.labelKey), keys: keysOf(command) }));
  const sections = [
    ...GROUPS.map((group) => ({ id: group as string, rows: rowsOf(group) })),
    {
      id: 'onCanvas',
      rows: CANVAS_KEYS.map(([id, keys]) => ({ id, label: t(`key.${id}`), keys: shortcutLabel(keys) })),
    },
  ];
  return (
    <Modal
      opened={isOpen}
      onClose={closeShortcuts}
      title={t('shortcuts')}
      size={820}
      closeButtonProps={{ 'aria-label': t('close') }}
    >
      <div className={classes['columns']} data-testid="shortcuts">
        {sections
          .filter(({ rows }) => rows.length > 0)
          .map(({ id, rows }) => (
            <section key={id} aria-label={t(`group.${id}`)}>
              <Title order={3} size={13} mb={4}>
                {t(`group.${id}`)}
              </Title>
              <Table verticalSpacing={4} horizontalSpacing={0} withRowBorders={false}>
                <Table.Tbody>
                  {rows.map((row) => (
                    <Table.Tr key={row.id}>
                      <Table.Td>{row.label}</Table.Td>
                      <Table.Td ta="right">
                        <Kbd size="xs">{row.keys}</Kbd>
                      </Table.Td>
                    </Table.Tr>
                  ))}
                </Table.Tbody>
              </Table>
            </section>
          ))}
      </div>
    </Modal>
  );
}
