"""Commands that look into a running tree: `debug`, `dap`, `attach`."""
